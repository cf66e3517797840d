"""Permissions that rules do not grant: rules that hinder a skill within its permissions."""

from __future__ import annotations

from collections.abc import Iterator

import z3

from crosscheck.asking import runs
from crosscheck.errors import NotGranted
from crosscheck.kinds import (
    KINDS,
    BehaviorKind,
    by_dimension,
    is_within,
    permissions_of,
    signals_of,
    widest,
)
from crosscheck.robot import Robot
from dslkit.diagnostics import Diagnostic
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.state import ArbitraryState
from rossmarie.ir import Machine
from rossmarie.naming import effect_target
from rossmarie.skills import Permission, PermissionLimit, Skill


def find_not_granted(robot: Robot, inquiry: Inquiry) -> Iterator[Diagnostic]:
    """A warning for each permission and each rule that hinders the skill nevertheless."""
    for skill in robot.skills.skills.values():
        names = {use.name for use in skill.uses}
        hindering = [
            rule for rule in range(len(robot.machine.rules)) if names & touched(robot.machine, rule)
        ]
        for kind in KINDS:
            farthest = widest(permissions_of(skill, kind), kind)
            if farthest is None:
                continue
            permission, limit = farthest
            for rule in hindering:
                if _hinders(robot, inquiry, skill, rule, limit, kind):
                    yield _finding(robot, skill, permission, rule)


def touched(machine: Machine, rule: int) -> set[str | None]:
    """The names of everything that a rule affects, including topics and servers."""
    plans = machine.reactions.plans
    tasks = plans[rule].tasks if plans else ()
    return {effect_target(machine, machine.reactions.tasks[task].effect) for task in tasks}


def _hinders(
    robot: Robot,
    inquiry: Inquiry,
    skill: Skill,
    rule: int,
    limit: PermissionLimit,
    kind: BehaviorKind,
) -> bool:
    """Say whether a rule can be active while a skill runs within its permissions."""
    machine = robot.machine
    signals = by_dimension(signals_of(machine, rule, kind), machine, limit)
    if not signals:
        return False

    def acts_within(state: ArbitraryState) -> z3.BoolRef:
        return z3.And(
            runs(state, skill.name),
            is_within(state, signals, limit, kind),
            state.proposition(machine.rules[rule].condition).true,
        )

    return inquiry.is_possible(acts_within, settled=True)


def _finding(robot: Robot, skill: Skill, permission: Permission, rule: int) -> Diagnostic:
    hindering = robot.machine.rules[rule]
    written = robot.program.rules[rule].condition.span
    found = NotGranted(
        skill=skill.name,
        permission=str(permission),
        rule=hindering.name,
        condition=" ".join(written.text.split()),
    )
    label = NotGranted.Acting(skill=skill.name).at(written)
    return found.at(robot.span_of(permission.place), label)
