"""Exemptions of rules, compared with the permissions of their skills."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import z3

from crosscheck.asking import runs
from crosscheck.errors import ExemptionWithoutTree, NotPermitted, WiderThanPermitted
from crosscheck.kinds import (
    KINDS,
    BehaviorKind,
    by_dimension,
    compared_by,
    is_beyond,
    permissions_of,
    signals_of,
    widest,
)
from crosscheck.robot import Robot
from dslkit.diagnostics import Diagnostic
from rossmarie.analysis.activity import becomes_active
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.state import ArbitraryState
from rossmarie.skills import Permission, PermissionLimit, Skill
from rossmarie.syntax import ast


@dataclass(frozen=True)
class Exempted:
    """An exemption of a rule, by its number in the machine, and its skills."""

    rule: int
    written: ast.Exemption
    skills: tuple[Skill, ...]


def exemptions_of(robot: Robot) -> Iterator[Exempted]:
    """All exemptions, in the order of the rules."""
    for number, rule in enumerate(robot.program.rules):
        for written in rule.exemptions:
            names = robot.program.doing[written.doing].skills
            skills = (robot.skills.skills[name] for name in names if name in robot.skills.skills)
            yield Exempted(number, written, tuple(skills))


def find_unused(robot: Robot) -> Iterator[Diagnostic]:
    """A warning for each exemption whose skills are in no tree."""
    for exempted in exemptions_of(robot):
        if any(any(robot.callers(skill.name)) for skill in exempted.skills):
            continue
        named = exempted.written.doing.skill.text
        described = robot.skills.skills[named].place
        found = ExemptionWithoutTree(skill=named, rule=robot.machine.rules[exempted.rule].name)
        label = ExemptionWithoutTree.Described().at(robot.span_of(described))
        yield found.at(exempted.written.doing.span, label)


def find_wider(robot: Robot, inquiry: Inquiry) -> Iterator[Diagnostic]:
    """An error for each exemption that lets a skill do more than its permissions."""
    for exempted in exemptions_of(robot):
        for kind in KINDS:
            signals = signals_of(robot.machine, exempted.rule, kind)
            for skill in exempted.skills if signals else ():
                yield from _wider(robot, inquiry, exempted, skill, kind, signals)


def _wider(
    robot: Robot,
    inquiry: Inquiry,
    exempted: Exempted,
    skill: Skill,
    kind: BehaviorKind,
    signals: tuple[int, ...],
) -> Iterator[Diagnostic]:
    permissions = permissions_of(skill, kind)
    rule = robot.machine.rules[exempted.rule].name
    if not permissions:
        found = NotPermitted(rule=rule, skill=skill.name, kind=kind.words, example=kind.example)
        label = NotPermitted.Described(kind=kind.words).at(robot.span_of(skill.place))
        yield found.at(exempted.written.doing.span, label)
        return
    farthest = widest(permissions, kind)
    if farthest is None:
        return
    permission, limit = farthest
    compared = by_dimension(signals, robot.machine, limit)
    if compared and not _is_enforced(robot, inquiry, skill, compared, limit, kind):
        yield _unenforced(robot, exempted, skill, permission, limit, compared, kind)


def _is_enforced(
    robot: Robot,
    inquiry: Inquiry,
    skill: Skill,
    signals: tuple[int, ...],
    limit: PermissionLimit,
    kind: BehaviorKind,
) -> bool:
    """Say whether it is proved that some rule acts beyond the limit while a skill runs."""
    machine = robot.machine
    acting = [
        rule
        for rule in range(len(machine.rules))
        if machine.rules[rule].actions and not set(signals).isdisjoint(compared_by(machine, rule))
    ]

    def nobody_acts(state: ArbitraryState) -> z3.BoolRef:
        acts = [becomes_active(state, rule) for rule in acting]
        return z3.And(
            runs(state, skill.name),
            is_beyond(state, signals, limit, kind),
            *(z3.Not(each) for each in acts),
        )

    return inquiry.is_impossible(nobody_acts, settled=True)


def _unenforced(
    robot: Robot,
    exempted: Exempted,
    skill: Skill,
    permission: Permission,
    limit: PermissionLimit,
    signals: tuple[int, ...],
    kind: BehaviorKind,
) -> Diagnostic:
    sign = "<" if kind.is_least else ">"
    found = WiderThanPermitted(
        rule=robot.machine.rules[exempted.rule].name,
        skill=skill.name,
        shown=f"{robot.machine.signals[signals[0]].text} {sign} {limit}",
        limit=f"{sign} {limit}",
    )
    label = WiderThanPermitted.Permitted().at(robot.span_of(permission.place))
    return found.at(exempted.written.doing.span, label)
