"""The pages about plans: their examples are planned."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros import catalog
from support.markdown import Block, blocks
from support.planning import planned
from support.tree_files import checked

PAGES = sorted((Path(catalog.__file__).parent / "pages").glob("EZS85*.md"))
WITHOUT_EXAMPLE = ("EZS855", "EZS858")


def written(page: Path, heading: str) -> list[Block]:
    return [each for each in blocks(page.read_text("utf-8")) if each.heading == heading]


@pytest.mark.parametrize("heading", ["Example", "Write instead"])
@pytest.mark.parametrize(
    "page", [each for each in PAGES if each.stem not in WITHOUT_EXAMPLE], ids=lambda page: page.stem
)
def test_the_example_has_the_finding(page: Path, heading: str, tmp_path: Path) -> None:
    """The text under "Write instead" replaces its parts of the example."""
    for block in (*written(page, "Example"), *(written(page, heading))):
        (tmp_path / (block.name or "goal")).write_text(block.text, encoding="utf-8")
    goal = (tmp_path / "goal").read_text("utf-8").strip()
    plan, said = planned(checked(tmp_path / "skill.py"), goal, tmp_path / "lab.turtle")
    codes = {each.code for each in said}
    if heading == "Example":
        assert page.stem in codes
    else:
        assert codes == set()
        assert plan is not None
