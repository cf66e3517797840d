"""The skills that are known to run when a rule becomes active."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import z3

from crosscheck.asking import acts, asked_by, runs, stands_still
from crosscheck.robot import Robot
from dslkit.diagnostics import listed
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.state import ArbitraryState
from rossmarie.skills import Skill


@dataclass(frozen=True)
class Situation:
    """Skills that all run when a rule becomes active. Other skills may run at the same time."""

    skills: tuple[Skill, ...]

    def has(self, skill: str) -> bool:
        """Say whether a skill is known to run."""
        return any(each.name == skill for each in self.skills)

    def __str__(self) -> str:
        """The situation in words, such as `while Drive runs`."""
        if not self.skills:
            return "while any skill runs"
        names = listed([each.name for each in self.skills])
        return f"while {names} {'runs' if len(self.skills) == 1 else 'run'}"


def situations(robot: Robot, inquiry: Inquiry, rule: int) -> list[Situation]:
    """All situations in which a rule becomes active; each is proved by z3."""
    about = inquiry.about(rule)
    names = [
        name
        for step in asked_by(robot.machine, rule)
        if not step.is_ahead
        for name in step.skills
        if name in robot.skills.skills
    ]
    asked = [name for name in dict.fromkeys(names) if _may_run(about, name)]
    always = [name for name in asked if _needs_one_of(about, [name])]
    others = [name for name in asked if name not in always]
    found = [always]
    if others and _needs_one_of(about, others):
        found = [[*always, name] for name in others]
    return [Situation(tuple(robot.skills.skills[name] for name in each)) for each in found]


def _may_run(about: Inquiry, skill: str) -> bool:
    """Say whether a rule may become active while a skill runs."""
    return not about.is_impossible(lambda state: z3.And(runs(state, skill), acts(state, 0)))


def _needs_one_of(about: Inquiry, skills: Sequence[str]) -> bool:
    """Say whether it is proved that a rule becomes active only while one of some skills runs."""

    def acts_without(state: ArbitraryState) -> z3.BoolRef:
        return z3.And(*(stands_still(state, each) for each in skills), acts(state, 0))

    return about.is_impossible(acts_without)
