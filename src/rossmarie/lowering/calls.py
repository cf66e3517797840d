"""The calls of skills that the questions of a machine tell apart, of each kind one.

A question asks for skills and for classes of arguments, so that two calls with the same answers
are one to the machine. Which answers there can be together is what solvers have to know.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product

from rossmarie import ir
from rossmarie.check.model import CheckedSkills
from rossmarie.skills import Skill

MOST_CALLS = 512
"""The most calls that are kept. Of more, nothing is known of which answers go together."""


def calls_of(skills: CheckedSkills, steps: Sequence[ir.Doing]) -> tuple[ir.SkillCall, ...]:
    """One call for each combination of answers that a single call can give, but that of no yes."""
    found: dict[tuple[bool, ...], ir.SkillCall] = {}
    for skill in skills.file.skills.values():
        for call in _calls_of(skill, skills, steps):
            answers = tuple(call.answers(step) for step in steps)
            if any(answers):
                found.setdefault(answers, call)
            if len(found) > MOST_CALLS:
                return ()
    return tuple(found.values())


def _calls_of(
    skill: Skill, skills: CheckedSkills, steps: Sequence[ir.Doing]
) -> Iterator[ir.SkillCall]:
    asked: dict[str, list[tuple[str, ...]]] = {}
    for step in steps:
        for parameter, classes in step.arguments if skill.name in step.skills else ():
            asked.setdefault(parameter, []).append(classes)
    types = {
        each.name: each.type
        for each in skill.parameters.values()
        if each.type in skills.file.classes
    }
    choices = [_kinds(types[name], asked.get(name, []), skills) for name in sorted(types)]
    for chosen in product(*choices):
        pairs = tuple(zip(sorted(types), chosen, strict=True))
        told = [f"{name}: {kind}" for name, kind in pairs if kind != types[name]]
        limits = f"({', '.join(told)})" if told else ""
        yield ir.SkillCall(skill.name, pairs, f"doing {skill.name}{limits}")


def _kinds(type_: str, asked: Sequence[tuple[str, ...]], skills: CheckedSkills) -> list[str]:
    """Classes that an argument may have, of each kind that the questions tell apart one; the most
    general first.
    """
    below = sorted(
        skills.classes.below(type_), key=lambda name: (len(skills.classes.above(name)), name)
    )
    found: dict[tuple[bool, ...], str] = {}
    for name in below:
        found.setdefault(tuple(name in classes for classes in asked), name)
    return list(found.values())
