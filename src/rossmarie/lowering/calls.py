"""The calls of skills that the queries of a machine distinguish, one of each kind.

A query names skills and classes of arguments, so two calls with the same answers are equivalent to
the machine. Solvers need the answers that can occur together.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import product
from typing import TypeAlias

from rossmarie import ir
from rossmarie.check.model import CheckedSkills
from rossmarie.skills import Skill, SkillParameter

MOST_CALLS = 512
"""The most calls that are kept. If there are more calls, the machine has no information about
answers that occur together.
"""

Kinds: TypeAlias = tuple[str, ...]
"""All classes of one argument."""

NO_VALUE: Kinds = ("",)
"""The class of an argument without a value."""

NOT_KNOWN: Kinds = ()
"""The classes of an unknown argument of a skill that can start next."""


def calls_of(skills: CheckedSkills, steps: Sequence[ir.Doing]) -> tuple[ir.SkillCall, ...]:
    """One call for each combination of answers that a single call can give. The combination with
    only "no" is left out.
    """
    found: dict[tuple[bool, ...], ir.SkillCall] = {}
    kinds = sorted({step.is_ahead for step in steps})
    for skill, is_ahead in product(skills.file.skills.values(), kinds):
        for call in _calls_of(skill, skills, steps, is_ahead=is_ahead):
            answers = tuple(call.answers(step) for step in steps)
            if any(answers) and (answers not in found or found[answers].text is None):
                found[answers] = call
            if len(found) > MOST_CALLS:
                return ()
    return tuple(found.values())


def _calls_of(
    skill: Skill, skills: CheckedSkills, steps: Sequence[ir.Doing], *, is_ahead: bool
) -> Iterator[ir.SkillCall]:
    asked: dict[str, list[tuple[str, ...]]] = {}
    for step in (each for each in steps if each.is_ahead == is_ahead):
        for parameter, classes in step.arguments if skill.name in step.skills else ():
            asked.setdefault(parameter, []).append(classes)
    individuals = sorted(
        (each for each in skill.parameters.values() if each.type in skills.file.classes),
        key=lambda each: each.name,
    )
    choices = [_kinds(each, asked.get(each.name, []), skills) for each in individuals]
    if is_ahead:
        choices = [[*kinds, NOT_KNOWN] for kinds in choices]
    for chosen in product(*choices):
        pairs = list(zip(individuals, chosen, strict=True))
        yield ir.SkillCall(
            skill.name,
            tuple((individual.name, kind) for individual, kinds in pairs for kind in kinds),
            _text(skill, pairs, "ahead" if is_ahead else "doing"),
            is_ahead,
        )


def _text(skill: Skill, chosen: Sequence[tuple[SkillParameter, Kinds]], word: str) -> str | None:
    """The call in the notation of tests. None if the call has an individual with several classes,
    or a missing individual, because the notation cannot express them.
    """
    if not all(len(kinds) == 1 and kinds != NO_VALUE for _, kinds in chosen):
        return None
    reported = [
        f"{individual.name}: {kind}" for individual, (kind,) in chosen if kind != individual.type
    ]
    limits = f"({', '.join(reported)})" if reported else ""
    return f"{word} {skill.name}{limits}"


def _kinds(
    individual: SkillParameter, asked: Sequence[tuple[str, ...]], skills: CheckedSkills
) -> list[Kinds]:
    """The classes that an argument may have, one for each kind that the queries distinguish, the
    most general first. An individual can have other classes besides the class that its parameter
    requires. Any parameter may have no value: this is how an individual that has left the world is
    reported.
    """
    below, above = skills.classes.below(individual.type), skills.classes.above(individual.type)
    own = _distinguished(below, asked, skills)
    others = _distinguished(
        {name for each in asked for name in each} - {*below, *above}, asked, skills
    )
    found: dict[tuple[bool, ...], Kinds] = {answers: (name,) for answers, name in own.items()}
    found.setdefault((False,) * len(asked), NO_VALUE)
    for one, name in own.items():
        for other, beside in others.items():
            both = tuple(yes or also for yes, also in zip(one, other, strict=True))
            found.setdefault(both, (name, beside))
    return list(found.values())


def _distinguished(
    names: Iterable[str], asked: Sequence[tuple[str, ...]], skills: CheckedSkills
) -> dict[tuple[bool, ...], str]:
    """Classes by their answers to the queries, the most general class for each combination of
    answers.
    """
    found: dict[tuple[bool, ...], str] = {}
    for name in sorted(names, key=lambda name: (len(skills.classes.above(name)), name)):
        found.setdefault(tuple(name in classes for classes in asked), name)
    return found
