"""Migrated skills that are built on a class with a client, in real SkiROS2."""
# mypy: disable-error-code="no-untyped-call"

from __future__ import annotations

from typing import Any

import pytest

from support import skiros2_core
from support.old_callers import new_callers
from support.parts import SKIROS2, needs

pytestmark = [
    needs(SKIROS2),
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),  # of what SkiROS2 uses
]
TREES = """

class Task(SkillDescription):
    def description(self):
        pass


class twice(Task.SkillBase):
    def expandBT(self, params):
        self.serialstar(Greet.greet(Text="once"), Greet.greet(Text="again"))


class soon(Task.SkillBase):
    def expandBT(self, params):
        self.parallelfs(Greet.greet(Ticks=9), Greet.greet(Text="short", Ticks=2))


class over(Task.SkillBase):
    def expandBT(self, params):
        self.retry(self.inverter(Greet.greet(Ticks=1)), 2)


class nobody(Task.SkillBase):
    def expandBT(self, params):
        self.serialstar(Greet.greet_nobody())
"""


@pytest.mark.parametrize(
    ("tree", "state", "asked", "reported"),
    [
        ("twice", "Success", ["made", "once", "made", "again"], "greet Success greeted"),
        (
            "soon",
            "Success",
            ["made", "hello", "made", "short", "cancelled"],
            "greet Failure cancelled",
        ),
        ("over", "Failure", ["made", "hello", "hello"], "greet Success greeted"),
        ("nobody", "Failure", ["made"], "greet_nobody Failure nobody listens"),
    ],
)
def test_skills_on_a_base_run(
    package: Any, tree: str, state: str, asked: list[str], reported: str
) -> None:
    name = package("library", new_callers() + TREES)
    core = skiros2_core.Core()
    core.load(name, tree)
    found, texts = core.run("Task", tree)
    module = __import__(f"{name}.skills").skills
    assert (found, module.Client.asked) == (state, asked)
    assert reported in texts
