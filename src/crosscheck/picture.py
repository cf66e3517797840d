"""A robot as a list: its skills, the resources of each, and the related rules."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from crosscheck.asking import asked_by
from crosscheck.exemptions import exemptions_of
from crosscheck.permissions import touched
from crosscheck.robot import Robot
from rossmarie.ir.taking import takings
from rossmarie.skills import Skill


@dataclass(frozen=True)
class Guarded:
    """A rule that affects a resource of a skill, and may take it away."""

    rule: str
    resource: str
    is_taken: bool

    def __str__(self) -> str:
        return f"{self.rule} ({self.resource})"


@dataclass(frozen=True)
class Pictured:
    """A skill: its resources and permissions, the rules that affect its resources, the rules that
    are not applied while it runs, and the rules that query it.
    """

    name: str
    children: tuple[str, ...]
    uses: tuple[str, ...]
    permits: tuple[str, ...]
    guards: tuple[Guarded, ...]
    exempt_from: tuple[str, ...]
    asked_by: tuple[str, ...]


def pictured(robot: Robot) -> Iterator[Pictured]:
    """All skills, in the order of the file."""
    for skill in robot.skills.skills.values():
        yield _pictured(robot, skill)


def _pictured(robot: Robot, skill: Skill) -> Pictured:
    machine = robot.machine
    rules = [rule.name for rule in machine.rules]
    exempt = {rules[each.rule]: None for each in exemptions_of(robot) if skill in each.skills}
    asking = [
        rule.name
        for number, rule in enumerate(machine.rules)
        if rule.exempts is None
        and rule.name not in exempt
        and any(skill.name in step.skills for step in asked_by(machine, number))
    ]
    return Pictured(
        name=skill.name,
        children=tuple(dict.fromkeys(child.skill for child in skill.children)),
        uses=tuple(dict.fromkeys(use.name for use in skill.uses)),
        permits=tuple(map(str, skill.permits)),
        guards=tuple(_guards(robot, skill)),
        exempt_from=tuple(exempt),
        asked_by=tuple(asking),
    )


def _guards(robot: Robot, skill: Skill) -> Iterator[Guarded]:
    taken = {(each.rule, each.use.name) for each in takings(robot.machine, skill.uses)}
    for number, rule in enumerate(robot.machine.rules):
        resources = touched(robot.machine, number)
        for name in dict.fromkeys(use.name for use in skill.uses):
            if name in resources:
                yield Guarded(rule.name, name, (number, name) in taken)
