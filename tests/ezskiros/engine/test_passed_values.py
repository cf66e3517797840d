"""Values on their way through a tree: tests/ezskiros/hosts asks SkiROS2 for the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.engine.events import Happened
from support.engine import Skills
from support.passed_values import IDS, TREES
from support.passed_values import skills as passing


@pytest.mark.parametrize(("tree", "reported"), TREES, ids=IDS)
def test_values_reach_the_children_that_they_are_passed_to(
    tmp_path: Path, tree: str, reported: list[str]
) -> None:
    ran = Skills(tmp_path, passing(tree)).run("Task", "Mine=8.0")
    assert ran.outcome.is_success
    ended = (Happened.SUCCEEDED, Happened.FAILED)
    primitives = ("Push", "Weigh", "Double")
    found = [each for each in ran.events if each.happened in ended]
    assert [each.text for each in found if each.path[-1].startswith(primitives)] == reported
