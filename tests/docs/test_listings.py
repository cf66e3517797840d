"""Listings that a reader copies first can be built for a robot, and fit into one workspace."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import pytest

from rossmarie.driver.build import build_files
from rossmarie.naming import public_prefix
from support.markdown import blocks

ROOT = Path(__file__).parents[2]
FIRST = ("README.md", "docs/tutorial/tour.md", "docs/tutorial/first-rules.md")
"""Pages whose listings, but those with planted faults, are built for either generation of ROS."""

FAULTY = {"wrong.ross"}
FOLDERS = ("examples", "src/heron/rules")
NO_RULES = {"system.ross"}


def first_listings() -> Iterator[object]:
    for page in FIRST:
        for block in blocks((ROOT / page).read_text(encoding="utf-8")):
            if block.language == "ross" and block.name not in FAULTY:
                name = f"{Path(page).stem}:{block.line}"
                yield pytest.param(block.name, block.text, id=name)


@pytest.mark.parametrize("target", ["ros1", "ros2"])
@pytest.mark.parametrize(("name", "text"), list(first_listings()))
def test_the_first_listings_build_as_they_stand(
    name: str, text: str, target: str, tmp_path: Path
) -> None:
    rules = tmp_path / name
    rules.write_text(text, encoding="utf-8")
    written = build_files(rules, target, tmp_path / "package").written
    assert tmp_path / "package" / "package.xml" in written


def places() -> Iterator[tuple[str, str]]:
    """The name of a file of rules that somebody may build, and where it stands.

    A page may show a file several times, as it grows.
    """
    for page in sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")]):
        for block in blocks(page.read_text(encoding="utf-8")):
            if block.language == "ross" and block.name:
                yield block.name, str(page.relative_to(ROOT))
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*.ross")):
            if path.name not in NO_RULES:
                yield path.name, str(path.relative_to(ROOT))


def test_packages_of_examples_have_names_of_their_own() -> None:
    found: dict[str, set[str]] = defaultdict(set)
    for name, place in places():
        found[public_prefix(Path(name).stem)].add(place)
    assert len(found) > 20
    assert {name: where for name, where in found.items() if len(where) > 1} == {}
