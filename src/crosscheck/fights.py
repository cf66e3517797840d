"""Conflicts of rules and skills: the rule ends the skill, the end clears the rule, and the tree
restarts the skill.
"""

from __future__ import annotations

from collections.abc import Iterator

import z3

from crosscheck.asking import acts, stands_still
from crosscheck.errors import Fight
from crosscheck.releases import is_cleared_at_once
from crosscheck.robot import Robot
from dslkit.diagnostics import Diagnostic
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.state import ArbitraryState
from rossmarie.ir.taking import Taking, takings
from rossmarie.skills import ChildSkill, Skill


def find_fights(robot: Robot, inquiry: Inquiry) -> Iterator[Diagnostic]:
    """A warning for each rule and each skill that the rule ends and a tree restarts."""
    machine = robot.machine
    for skill in robot.skills.skills.values():
        again = _started_again(robot, skill)
        if again is None:
            continue
        reported: set[int] = set()
        for taking in takings(machine, skill.uses):
            if taking.rule not in reported and is_cleared_at_once(
                machine, machine.rules[taking.rule]
            ):
                reported.add(taking.rule)
                if _acts_only_with(inquiry, taking.rule, skill.name):
                    yield _finding(robot, skill, taking, again)


def _started_again(robot: Robot, skill: Skill) -> ChildSkill | None:
    """A place in a tree that restarts a skill after it has failed."""
    children = (child for each in robot.skills.skills.values() for child in each.children)
    return next((each for each in children if each.skill == skill.name and each.is_retried), None)


def _acts_only_with(inquiry: Inquiry, rule: int, skill: str) -> bool:
    """Say whether it is proved that a rule is not active once a skill has ended."""
    about = inquiry.about(rule)

    def acts_without(state: ArbitraryState) -> z3.BoolRef:
        return z3.And(stands_still(state, skill), acts(state, 0))

    return about.is_impossible(acts_without)


def _finding(robot: Robot, skill: Skill, taking: Taking, again: ChildSkill) -> Diagnostic:
    rule = robot.machine.rules[taking.rule]
    action = robot.machine.reactions.actions[taking.task.action].name
    ended = Fight.Ended(action=action, skill=skill.name, resource=taking.use.name)
    return Fight(rule=rule.name, skill=skill.name).at(
        rule.head,
        ended.at(taking.task.span),
        Fight.Started().at(robot.span_of(again.place)),
    )
