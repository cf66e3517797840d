"""Behavior trees of the fixtures, for drawing and planning."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ezskiros.driver import Checked, check_paths
from ezskiros.ontology.load import VARIABLE
from support.ontologies import HALL

TREES = Path(__file__).parents[1] / "fixtures" / "ezskiros" / "trees"
SCENE = TREES / "lab.turtle"
START = """\
from ezskiros import *
from ezskiros.ontology import load
world = load()
cora, rparts, skiros = world.cora, world.rparts, world.skiros


class Wait(SkillDescription):
    def description(self, Duration: float):
        pass


class wait(Wait.SkillBase):
    def execute(self):
        return self.success(f"{self.params.Duration}")
"""
"""The beginning of a test's skills file."""


@contextmanager
def hall() -> Iterator[None]:
    """Within, `load()` loads the ontology of the example."""
    before = os.environ.get(VARIABLE)
    os.environ[VARIABLE] = str(HALL)
    try:
        yield
    finally:
        if before is None:
            del os.environ[VARIABLE]
        else:
            os.environ[VARIABLE] = before


def checked(path: Path = TREES) -> Checked:
    """The skills of a file or folder, with the ontology of the example."""
    with hall():
        return check_paths([path])


def checked_text(text: str, folder: Path) -> Checked:
    """Skills that are written behind `START`."""
    path = folder / "skill.py"
    path.write_text(START + text, encoding="utf-8")
    return checked(path)
