"""Random messages that tell which skills run, those that nobody can read among them, and queries
to them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cache
from random import Random
from typing import Any, TypeVar

from rosbags.typesys import get_types_from_msg
from rosbags.typesys.store import Typestore

from rossmarie.ir import Doing, Quantity, SkillCall, SkillStep
from rossmarie.ir.skills import (
    RunningSkill,
    SkillArgument,
    SkillContext,
    SkillProperty,
    answer,
)
from rossmarie.types.definitions import own_texts
from support.recordings import ROS1, ROS2, stamped

DIGEST = "c0ffee"
SKILLS = ("Drive", "Insert", "Push", "PushGently")
PARAMETERS = ("Depth", "Object", "Target")
CLASSES = ("skiros.Box", "skiros.Fragile", "sumo.Object")
PROPERTIES = ("skiros.Length", "skiros.Weight")
Each = TypeVar("Each")

_NUMBERS = (math.nan, math.inf, -math.inf, 0.0, -0.0, 0.1, 1.0, -2.5e-308, 7.25)


def random_context(random: Random) -> SkillContext:
    """A context that can be read, but for one in five."""
    ahead = tuple(replace(each, is_ahead=True) for each in _skills(random))
    context = SkillContext(DIGEST, tuple(_skills(random)), ahead)
    return random_lie(random, context) if random.random() < 0.2 else context


def random_lie(random: Random, context: SkillContext) -> SkillContext:
    """The same with something that makes it unreadable for some queries, or for all."""
    lies = [
        replace(context, digest=random.choice(["", "c0ffe", "c0ffee0"])),
        replace(context, running=crowd(65, RunningSkill("Drive"))),
        replace(context, running=crowd(64, RunningSkill("Drive"))),
        replace(context, ahead=crowd(65, RunningSkill("Drive", is_ahead=True))),
        replace(context, ahead=crowd(64, RunningSkill("Drive", is_ahead=True))),
        replace(context, is_ahead_known=False),
        _with_last(context, replace(_skill(random), arguments=crowd(65, SkillArgument("Depth")))),
        _with_last(context, RunningSkill("Push", (_overfull(65),))),
        _with_last(context, RunningSkill("Push", (_overfull(64),))),
        _with_last(context, RunningSkill("Push", (_overfull(2), _argument(random, "Object")))),
    ]
    return random.choice(lies)


def random_query(random: Random) -> SkillStep:
    """A query: one in five for a boolean that is an argument."""
    skills = _some(random, SKILLS)
    if random.random() < 0.6:
        parameters = sorted(random.sample(PARAMETERS, random.randrange(3)))
        limits = tuple((each, _some(random, CLASSES)) for each in parameters)
        return Doing(DIGEST, skills, limits, is_ahead=random.random() < 0.3)
    properties = random.choice([None, *PROPERTIES])
    is_boolean = random.random() < 0.5
    return Quantity(DIGEST, skills, random.choice(PARAMETERS), properties, is_boolean=is_boolean)


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


# --- for random machines ---------------------------------------------------------------------

_CHOSEN = Random(63)
QUERIES = tuple(random_query(_CHOSEN) for _ in range(24))
CONTEXTS = tuple(random_context(_CHOSEN) for _ in range(60))


@cache
def reported(step: SkillStep, number: int) -> float:
    """The answer of one of these contexts to a query."""
    return answer(step, CONTEXTS[number])


def calls_reported(steps: Sequence[Doing]) -> tuple[SkillCall, ...]:
    """Calls of skills, one for each combination of answers that a skill in these contexts gives."""
    found: dict[tuple[bool, ...], SkillCall] = {}
    for skill in (each for context in CONTEXTS for each in (*context.running, *context.ahead)):
        types = tuple((each.parameter, each.type) for each in skill.arguments)
        call = SkillCall(skill.skill, types, None, skill.is_ahead)
        answers = tuple(call.answers(step) for step in steps)
        if any(answers):
            found.setdefault(answers, call)
    return tuple(found.values())


# --- as messages -------------------------------------------------------------------------------

for _store in (ROS1, ROS2):
    for _name, _text in own_texts().items():
        _store.register(get_types_from_msg(_text, _name.replace("/", "/msg/")))


def message(ros: Typestore, index: int, context: SkillContext) -> tuple[str, object]:
    """The name of the type, and a message of it; `index` counts messages of 10 Hz."""

    def made(kind: str, **fields: Any) -> object:
        return ros.types[f"skill_context_msgs/msg/{kind}"](**fields)

    def argument(each: SkillArgument) -> object:
        properties = [made("SkillProperty", **vars(found)) for found in each.properties]
        return made("SkillArgument", **{**vars(each), "properties": properties})

    header: Any = stamped(ros, index)
    running = [
        made(
            "RunningSkill",
            skill=each.skill,
            goal=f"goal {number}",
            since=header.stamp,
            arguments=[argument(found) for found in each.arguments],
            permits=[],
        )
        for number, each in enumerate(context.running)
    ]
    ahead = [
        made(
            "SkillAhead",
            skill=each.skill,
            arguments=[argument(found) for found in each.arguments],
        )
        for each in context.ahead
    ]
    return "skill_context_msgs/msg/SkillContext", made(
        "SkillContext",
        header=header,
        digest=context.digest,
        running=running,
        ahead=ahead,
        is_ahead_known=context.is_ahead_known,
    )
