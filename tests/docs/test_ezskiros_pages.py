"""The page of each diagnostic of EzSkiROS: its example has the findings that stand in it, what to
write instead has not.

Skills without a name behind their fence are `skill.py`; ontologies are called as `load` calls them.
`load()` without a path loads the small ontology of the fixtures.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from dslkit.diagnostics import Severity
from ezskiros import catalog
from ezskiros.ontology.load import VARIABLE
from ezskiros.skills import load, tracing
from support import transcript
from support.markdown import Block, blocks, replace_block
from support.skills import ONTOLOGY, codes_in, compare_files, findings

_STAGES = (*range(240, 250), *range(700, 800), *range(830, 890))
ELSEWHERE = {f"EZS{number}" for number in _STAGES}
"""Those of other stages: their own test_pages.py in tests/ezskiros takes care of them."""
PAGES = [
    page
    for page in sorted((Path(catalog.__file__).parent / "pages").glob("EZS*.md"))
    if page.stem not in ELSEWHERE
]
LANGUAGES = ("python", "turtle", "xml", "yaml")


@pytest.fixture(autouse=True)
def in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Examples load the ontology of the fixtures, and files beside them; none takes long."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv(VARIABLE, str(ONTOLOGY))
    monkeypatch.setattr(tracing, "SECONDS", 1.0)
    monkeypatch.setattr(load, "SECONDS", 1.0)


def files(page: Path, heading: str) -> list[Block]:
    found = blocks(page.read_text(encoding="utf-8"))
    return [one for one in found if one.heading == heading and one.language in LANGUAGES]


def write(block: Block, folder: Path) -> Path:
    path = folder / (block.name or "skill.py")
    path.write_text(block.text, encoding="utf-8")
    return path


def rewrite(page: Path, block: Block, text: str) -> None:
    page.write_text(replace_block(page.read_text("utf-8"), block, text), encoding="utf-8")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_example_has_the_findings(page: Path, tmp_path: Path, bless: bool) -> None:
    written = {write(block, tmp_path): block for block in files(page, "Example")}
    if not written:
        return
    problems = compare_files([*written], bless=bless)
    assert not problems, "\n".join(problems)
    if bless:
        for path, block in reversed(written.items()):  # so that the lines of the others stay theirs
            rewrite(page, block, path.read_text(encoding="utf-8"))
    assert page.stem in codes_in(written)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_what_to_write_instead_is_fine(page: Path, tmp_path: Path) -> None:
    blocks_in_order = [*files(page, "Example"), *files(page, "Write instead")]
    written = {write(block, tmp_path) for block in blocks_in_order}
    found = findings(sorted(written))
    if files(page, "Example"):
        assert page.stem not in {one.code for one in found}
        assert [str(one) for one in found if one.severity is Severity.ERROR] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_an_example_that_can_be_run_has_a_counterpart(page: Path) -> None:
    assert bool(files(page, "Example")) == bool(files(page, "Write instead"))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_terminal_shows_what_is_printed(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv(VARIABLE)
    for block in blocks(page.read_text(encoding="utf-8")):
        if block.language == "console" and page.stem != "EZS900":  # a defect, if we knew one
            assert transcript.run(block.text, tmp_path) == []
