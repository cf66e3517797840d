"""Behavior trees that rules run, and the resources that the same rules take away from them.

An effect that is not awaited stays in force. So the effects before a tree in its rule, or parallel
to it, are in force while the tree runs.
"""

from __future__ import annotations

from collections.abc import Iterator

from crosscheck.recovery_errors import TreeHindered
from crosscheck.robot import Robot
from crosscheck.trees import TreeRun, skills_below, tree_runs
from dslkit.diagnostics import Diagnostic
from rossmarie.ir.taking import Taking, takings
from rossmarie.skills import Skill


def find_hindered(robot: Robot) -> Iterator[Diagnostic]:
    """An error for each tree that needs a resource that its own rule takes away."""
    for run in tree_runs(robot):
        for skill in skills_below(robot, run.skill):
            for taking in takings(robot.machine, skill.uses):
                if taking.rule == run.rule and _is_in_force(robot, run, taking):
                    yield _finding(robot, run, skill, taking)


def _is_in_force(robot: Robot, run: TreeRun, taking: Taking) -> bool:
    tasks, plan = robot.machine.reactions.tasks, robot.machine.reactions.plans[run.rule]
    if run.stage is None:
        return False
    before = (tasks[index] for stage in plan.stages[: run.stage + 1] for index in stage)
    return any(each is taking.task for each in before)


def _finding(robot: Robot, run: TreeRun, skill: Skill, taking: Taking) -> Diagnostic:
    rule = robot.machine.rules[run.rule].name
    found = TreeHindered(rule=rule, tree=run.skill.name, resource=taking.use.name)
    needed = TreeHindered.Needed(skill=skill.name, resource=taking.use.name)
    return found.at(
        taking.task.span,
        TreeHindered.Runs(tree=run.skill.name).at(run.task.span),
        needed.at(robot.span_of(taking.use.place)),
    )
