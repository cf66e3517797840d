"""Behavior trees that rules run, and what the same rules take away from them meanwhile.

An effect that nobody awaits stays in force: what stands before a tree in its rule, or beside it, is
in force while the tree runs.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from crosscheck.errors import TreeHindered
from crosscheck.robot import Robot
from dslkit.diagnostics import Diagnostic
from rossmarie.check.actions.trees import SERVER
from rossmarie.ir import reactions
from rossmarie.ir.taking import Taking, takings
from rossmarie.skills import Skill


@dataclass(frozen=True)
class _Run:
    """A rule that runs a tree: the task, its stage in the plan of the rule, and the skill."""

    rule: int
    task: reactions.Task
    stage: int
    skill: Skill


def find_hindered(robot: Robot) -> Iterator[Diagnostic]:
    """An error for each tree that needs something that its own rule takes away."""
    for run in _runs(robot):
        for skill in _below(robot, run.skill):
            for taking in takings(robot.machine, skill.uses):
                if taking.rule == run.rule and _is_in_force(robot, run, taking):
                    yield _finding(robot, run, skill, taking)


def _runs(robot: Robot) -> Iterator[_Run]:
    tasks = robot.machine.reactions.tasks
    for rule, plan in enumerate(robot.machine.reactions.plans):
        for number, stage in enumerate(plan.stages):
            for task in (tasks[index] for index in stage):
                skill = robot.skills.skills.get(_tree(task.effect) or "")
                if skill is not None:
                    yield _Run(rule, task, number, skill)


def _tree(effect: reactions.Effect) -> str | None:
    """The skill that an effect runs as a tree; None if it runs none."""
    if not isinstance(effect, reactions.SendGoal) or effect.server != SERVER:
        return None
    named = (each.value for each in effect.assignments if each.path == ("skill",))
    return next((value for value in named if isinstance(value, str)), None)


def _below(robot: Robot, skill: Skill) -> Iterator[Skill]:
    """A skill, and all that its trees have, each once."""
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


def _is_in_force(robot: Robot, run: _Run, taking: Taking) -> bool:
    tasks, plan = robot.machine.reactions.tasks, robot.machine.reactions.plans[run.rule]
    before = (tasks[index] for stage in plan.stages[: run.stage + 1] for index in stage)
    return any(each is taking.task for each in before)


def _finding(robot: Robot, run: _Run, skill: Skill, taking: Taking) -> Diagnostic:
    rule = robot.machine.rules[run.rule].name
    found = TreeHindered(rule=rule, tree=run.skill.name, thing=taking.use.name)
    needed = TreeHindered.Needed(skill=skill.name, thing=taking.use.name)
    return found.at(
        taking.task.span,
        TreeHindered.Runs(tree=run.skill.name).at(run.task.span),
        needed.at(robot.span_of(taking.use.place)),
    )
