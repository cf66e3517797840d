"""Implementations that are SkiROS2's own, of skills that are written for EzSkiROS."""

from __future__ import annotations

import pytest

from support.skill_files import checked
from support.trees import LIBRARY, findings

NATIVE = """

class dream(Skiros2Base):
    def createDescription(self):
        self.setDescription(Dream(), self.__class__.__name__)


class named(Skiros2Base):
    def createDescription(self):
        self.description = Dream


class grip_slowly(Skiros2Base):
    def createDescription(self):
        self.setDescription(Grip(), "slowly")
"""
BASE = "\n\nclass Skiros2Base:\n    pass\n"
TASK = """

class Task(SkillDescription):
    def description(self, Force: float):
        pass


class task(Task.SkillBase):
    def expandBT(self, params):
        {body}
"""


@pytest.mark.parametrize(
    ("body", "found"),
    [
        ("Dream()", [("EZS562", "dream")]),
        ("Dream.dream()", [("EZS562", "dream")]),
        ("self.serialstar(Dream(), Dream.dream(), Dream())", [("EZS562", "dream")]),
        ("self.serialstar(Grip(), Grip.grip_slowly())", [("EZS562", "grip_slowly")]),
        ("Grip()", []),
        ("Dream.named()", [("EZS521", "named")]),
    ],
)
def test_what_trees_need_is_reported_once_where_it_stands(
    body: str, found: list[tuple[str, str]]
) -> None:
    text = LIBRARY + BASE + NATIVE + TASK.format(body=body)
    assert findings(checked(text)) == found
