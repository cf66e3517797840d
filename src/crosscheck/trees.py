"""The recovery trees that rules run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from crosscheck.robot import Robot
from rossmarie.check.actions.trees import AFTERWARDS, PASSED, SERVER
from rossmarie.ir import reactions
from rossmarie.skills import Skill


@dataclass(frozen=True)
class TreeRun:
    """A rule that runs a tree: the task, its stage in the plan of the rule (None for an
    escalation), the goal, and the skill.
    """

    rule: int
    task: reactions.Task
    stage: int | None
    goal: reactions.SendGoal
    skill: Skill

    @property
    def afterwards(self) -> str:
        """The continuation of the task: `resume`, `retry` or `replan`."""
        (found,) = self._field(AFTERWARDS)
        return found

    @property
    def arguments(self) -> Mapping[str, str]:
        """The values that the rule gives, as texts by parameter name."""
        pairs = (each.partition("=") for each in self._field("arguments"))
        return {name: value for name, _, value in pairs}

    @property
    def passed(self) -> Mapping[str, tuple[str, str]]:
        """The parameters that take the value of a parameter of a running skill: that skill, and
        that parameter.
        """
        found = {}
        for name, value in self.arguments.items():
            if value.startswith(PASSED):
                skill, _, parameter = value.removeprefix(PASSED).partition(".")
                found[name] = skill, parameter
        return found

    def _field(self, name: str) -> tuple[str, ...]:
        values = (each.value for each in self.goal.assignments if each.path == (name,))
        value = next(values, ())
        if isinstance(value, str):
            return (value,)
        return tuple(str(each) for each in value) if isinstance(value, tuple) else ()


def tree_runs(robot: Robot) -> Iterator[TreeRun]:
    """The trees of all rules, in their order."""
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


def skills_below(robot: Robot, skill: Skill) -> Iterator[Skill]:
    """A skill, and all skills in its trees, each once."""
    found = {skill.name: skill}
    waiting = [skill]
    while waiting:
        each = waiting.pop()
        yield each
        for child in each.children:
            known = robot.skills.skills.get(child.skill)
            if known is not None and known.name not in found:
                found[known.name] = known
                waiting.append(known)
