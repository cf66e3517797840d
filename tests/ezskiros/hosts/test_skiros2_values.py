"""Values on their way through a tree in real SkiROS2: they are those of our engine."""
# mypy: disable-error-code="no-untyped-call"

from __future__ import annotations

from typing import Any

import pytest

from support import skiros2_core
from support.parts import SKIROS2, needs
from support.passed_values import IDS, TREES, skills

pytestmark = [
    needs(SKIROS2),
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),  # of what SkiROS2 uses
]


@pytest.mark.parametrize(("tree", "reported"), TREES, ids=IDS)
def test_values_reach_the_children_that_they_are_passed_to(
    package: Any, tree: str, reported: list[str]
) -> None:
    name = package("library", skills(tree))
    core = skiros2_core.Core()
    core.load(name, "task")
    state, found = core.run("Task", "task", Mine=8.0)
    assert state == "Success"
    assert [text.split(" ", 2)[2] for text in found] == reported
