"""Random messages that tell which skills run, those that nobody can read among them, and questions
to them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from random import Random
from typing import TypeVar

from rossmarie.ir import Doing, Quantity, SkillStep
from rossmarie.ir.skills import RunningSkill, SkillArgument, SkillContext, SkillProperty

DIGEST = "c0ffee"
SKILLS = ("Drive", "Insert", "Push", "PushGently")
PARAMETERS = ("Depth", "Object", "Target")
CLASSES = ("skiros.Box", "skiros.Fragile", "sumo.Object")
PROPERTIES = ("skiros.Length", "skiros.Weight")
Each = TypeVar("Each")

_NUMBERS = (math.nan, math.inf, -math.inf, 0.0, -0.0, 0.1, 1.0, -2.5e-308, 7.25)


def random_context(random: Random) -> SkillContext:
    """A context that can be read, but for one in five."""
    context = SkillContext(DIGEST, tuple(_skills(random)))
    return random_lie(random, context) if random.random() < 0.2 else context


def random_lie(random: Random, context: SkillContext) -> SkillContext:
    """The same with something that makes it unreadable for some questions, or for all."""
    lies = [
        replace(context, digest=random.choice(["", "c0ffe", "c0ffee0"])),
        replace(context, running=crowd(65, RunningSkill("Drive"))),
        replace(context, running=crowd(64, RunningSkill("Drive"))),
        _with_last(context, replace(_skill(random), arguments=crowd(65, SkillArgument("Depth")))),
        _with_last(context, RunningSkill("Push", (_overfull(65),))),
        _with_last(context, RunningSkill("Push", (_overfull(64),))),
    ]
    return random.choice(lies)


def random_question(random: Random) -> SkillStep:
    skills = _some(random, SKILLS)
    if random.random() < 0.6:
        parameters = sorted(random.sample(PARAMETERS, random.randrange(3)))
        limits = tuple((each, _some(random, CLASSES)) for each in parameters)
        return Doing(DIGEST, skills, limits)
    properties = random.choice([None, *PROPERTIES])
    return Quantity(DIGEST, skills, random.choice(PARAMETERS), properties)


def crowd(count: int, each: Each) -> tuple[Each, ...]:
    return (each,) * count


def _with_last(context: SkillContext, last: RunningSkill) -> SkillContext:
    return replace(context, running=(*context.running, last))


def _overfull(count: int) -> SkillArgument:
    return SkillArgument("Object", properties=crowd(count, SkillProperty("skiros.Weight", 1.0)))


def _some(random: Random, names: Sequence[str]) -> tuple[str, ...]:
    return tuple(sorted(random.sample(names, random.randint(1, 2))))


def _skills(random: Random) -> Iterator[RunningSkill]:
    for _ in range(random.choice([0, 1, 1, 2, 3])):
        yield _skill(random)


def _skill(random: Random) -> RunningSkill:
    names = random.sample(PARAMETERS, random.randrange(len(PARAMETERS) + 1))
    if names and random.random() < 0.1:
        names.append(random.choice(names))
    return RunningSkill(random.choice(SKILLS), tuple(_argument(random, each) for each in names))


def _argument(random: Random, parameter: str) -> SkillArgument:
    names = random.choices(PROPERTIES, k=random.randrange(3))
    return SkillArgument(
        parameter,
        value="anything",
        type=random.choice(["", *CLASSES]),
        number=random.choice(_NUMBERS),
        properties=tuple(SkillProperty(each, random.choice(_NUMBERS)) for each in names),
    )
