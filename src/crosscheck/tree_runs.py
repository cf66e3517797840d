"""Behavior trees that rules run: which rule, at which stage of its plan, and which skill."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from crosscheck.robot import Robot
from rossmarie.check.actions.trees import SERVER
from rossmarie.ir import reactions
from rossmarie.skills import Skill


@dataclass(frozen=True)
class TreeRun:
    """A rule that runs a tree: the task, its stage in the plan of the rule, None if it is an
    escalation; the goal, and the skill.
    """

    rule: int
    task: reactions.Task
    stage: int | None
    goal: reactions.SendGoal
    skill: Skill

    @property
    def given(self) -> dict[str, str]:
        """The values that the rule gives, as texts by the names of parameters."""
        texts = next((e.value for e in self.goal.assignments if e.path == ("arguments",)), ())
        pairs = (str(each).partition("=") for each in (texts if isinstance(texts, tuple) else ()))
        return {name: value for name, _, value in pairs}


def tree_runs(robot: Robot) -> Iterator[TreeRun]:
    """All trees that rules run."""
    tasks = robot.machine.reactions.tasks
    for rule, plan in enumerate(robot.machine.reactions.plans):
        stages = {index: number for number, stage in enumerate(plan.stages) for index in stage}
        for index in plan.tasks:
            goal = tasks[index].effect
            skill = robot.skills.skills.get(_tree(goal) or "")
            if skill is not None and isinstance(goal, reactions.SendGoal):
                yield TreeRun(rule, tasks[index], stages.get(index), goal, skill)


def _tree(effect: reactions.Effect) -> str | None:
    """The skill that an effect runs as a tree; None if it runs none."""
    if not isinstance(effect, reactions.SendGoal) or effect.server != SERVER:
        return None
    named = (each.value for each in effect.assignments if each.path == ("skill",))
    return next((value for value in named if isinstance(value, str)), None)
