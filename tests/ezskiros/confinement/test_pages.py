"""The pages of what breaks a check off: their examples do, and what to write instead does not."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros import catalog
from support import command_line
from support.markdown import blocks
from support.ontologies import HALL

PAGES = sorted((Path(catalog.__file__).parent / "pages").glob("EZS24*.md"))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
@pytest.mark.parametrize(("heading", "is_wrong"), [("Example", True), ("Write instead", False)])
def test_the_finding_is_as_the_page_says(
    page: Path, heading: str, is_wrong: bool, tmp_path: Path
) -> None:
    (block,) = (each for each in blocks(page.read_text("utf-8")) if each.heading == heading)
    (tmp_path / "skill.py").write_text(block.text)
    done = command_line.run("ezskiros", "check", "--ontology", HALL, "skill.py", folder=tmp_path)
    assert (f"error[{page.stem}]" in done.stdout) is is_wrong
    assert done.returncode == is_wrong
