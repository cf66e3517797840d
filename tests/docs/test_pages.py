"""The page of each diagnostic: its example has that finding, what to write instead has not."""

from __future__ import annotations

from pathlib import Path

import pytest

from dslkit.diagnostics import Severity
from rossmarie import catalog
from support import expectations
from support.checking import compare_file, findings, useless_fixes
from support.markdown import Block, blocks, replace_block
from support.rule_skills import put_skills

PAGES = sorted((Path(catalog.__file__).parent / "pages").glob("*.md"))


def programs(page: Path, heading: str) -> list[Block]:
    found = blocks(page.read_text(encoding="utf-8"))
    return [block for block in found if (block.language, block.heading) == ("ross", heading)]


def write(block: Block, folder: Path) -> Path:
    """The program of a block as a file; a block with a name is there for the ones after it."""
    put_skills(folder)
    path = folder / (block.name or "rules.ross")
    path.write_text(block.text, encoding="utf-8")
    return path


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_example_has_the_finding(page: Path, tmp_path: Path, bless: bool) -> None:
    for block in programs(page, "Example"):
        path = write(block, tmp_path)
        problems = compare_file(path, bless=bless)
        assert not problems, "\n".join(problems)
        text = path.read_text(encoding="utf-8")
        if bless:
            page.write_text(replace_block(page.read_text("utf-8"), block, text), "utf-8")
        if not block.name:
            assert page.stem in {expectation.code for expectation in expectations.parse(text)}
        assert useless_fixes(path) == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_what_to_write_instead_is_fine(page: Path, tmp_path: Path) -> None:
    for block in [*programs(page, "Example"), *programs(page, "Write instead")]:
        path = write(block, tmp_path)
        if block.heading == "Write instead":
            found = findings(path)
            assert page.stem not in {one.code for one in found}
            assert [one.title for one in found if one.severity is Severity.ERROR] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_an_example_that_can_be_run_has_a_counterpart(page: Path) -> None:
    if programs(page, "Example"):
        assert programs(page, "Write instead")
