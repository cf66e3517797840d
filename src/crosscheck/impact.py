"""Everything that depends on the description of one skill: trees and rules (thesis, Paper IV,
section 7: dependencies and changes).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from crosscheck.asking import asked_by
from crosscheck.exemptions import exemptions_of
from crosscheck.robot import Robot
from dslkit.source import Span
from rossmarie.ir.taking import takings
from rossmarie.skills import Skill


@dataclass(frozen=True)
class Dependent:
    """A part that a change of a skill may break: its name, its dependency, and its place."""

    what: str
    how: str
    span: Span


def dependents(robot: Robot, skill: Skill) -> Iterator[Dependent]:
    """Everything that depends on a skill. These are the skills derived from it, the compounds above
    it, and the rules that query it, are not applied while it runs, or take away its resources.
    """
    below = {each.name for each in _derived(robot, skill)} | {skill.name}
    for name in sorted(below - {skill.name}):
        derived = robot.skills.skills[name]
        yield Dependent(f"skill {name}", f"is derived from {skill.name}", _place(robot, derived))
    yield from _compounds(robot, below)
    yield from _rules(robot, skill)


def _derived(robot: Robot, skill: Skill) -> Iterator[Skill]:
    for each in robot.skills.skills.values():
        if skill.name in each.parents:
            yield each
            yield from _derived(robot, each)


def _place(robot: Robot, skill: Skill) -> Span:
    return robot.span_of(skill.place)


def _compounds(robot: Robot, names: set[str]) -> Iterator[Dependent]:
    """The compounds with a tree that contains one of some skills, and the compounds above them."""
    waiting, seen = sorted(names), set(names)
    while waiting:
        name = waiting.pop(0)
        for each in robot.callers(name):
            child = next(child for child in each.children if child.skill == name)
            how = f"has {name} in its tree"
            yield Dependent(f"skill {each.name}", how, robot.span_of(child.place))
            if each.name not in seen:
                seen.add(each.name)
                waiting.append(each.name)


def _rules(robot: Robot, skill: Skill) -> Iterator[Dependent]:
    for number, rule in enumerate(robot.machine.rules):
        for step in asked_by(robot.machine, number) if rule.exempts is None else ():
            if skill.name in step.skills:
                yield Dependent(f"rule {rule.name}", f"queries {step}", rule.head)
    for exempted in exemptions_of(robot):
        if skill in exempted.skills:
            name = robot.machine.rules[exempted.rule].name
            how = f"is not applied while {skill.name} runs"
            yield Dependent(f"rule {name}", how, exempted.written.span)
    for taking in takings(robot.machine, skill.uses):
        rule = robot.machine.rules[taking.rule]
        yield Dependent(f"rule {rule.name}", f"can take {taking.use.name} away", rule.head)
