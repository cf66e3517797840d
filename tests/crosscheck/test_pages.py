"""The page of each diagnostic: its example has that finding, what to write instead has not."""

from __future__ import annotations

from pathlib import Path

import pytest

from crosscheck import catalog
from dslkit.diagnostics import Severity
from support.markdown import Block, blocks
from support.robots import codes, found_with, put_example

PAGES = [
    page
    for page in sorted((Path(catalog.__file__).parent / "pages").glob("*.md"))
    if page.stem not in ("CHK204", "CHK213", "CHK303", "CHK900")
    and not page.stem.startswith("CHK4")
]


def of(page: Path, heading: str, language: str) -> list[Block]:
    found = blocks(page.read_text(encoding="utf-8"))
    return [block for block in found if (block.language, block.heading) == (language, heading)]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_example_has_the_finding_and_the_other_has_not(page: Path, tmp_path: Path) -> None:
    modules = {str(block.name): block.text for block in of(page, "Example", "python")}
    robot = put_example(tmp_path, modules)
    for heading, has_it in ("Example", True), ("Write instead", False):
        (rules,) = of(page, heading, "ross")
        scene = None
        for block in of(page, heading, "turtle"):
            scene = robot / "scene.turtle"
            scene.write_text(block.text, encoding="utf-8")
        found = found_with(robot, rules.text, scene)
        assert (page.stem in codes(found)) is has_it
        assert has_it or not any(each.severity is Severity.ERROR for each in found), found


def test_a_skill_that_never_works_is_shown_by_a_trace(tmp_path: Path) -> None:
    (wrong,) = of(next(page for page in PAGES if page.stem == "CHK201"), "Example", "ross")
    found = found_with(put_example(tmp_path), wrong.text)
    (reported,) = [each for each in found if each.code == "CHK201"]
    assert "doing Drive = true" in "\n".join(reported.notes)
