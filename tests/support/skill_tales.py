"""Random contexts in the words of a skills file: honest ones, and others that no robot tells."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from random import Random
from typing import Any

from rossmarie.ir.skills import RunningSkill, SkillArgument, SkillContext, SkillProperty
from support.skill_contexts import crowd
from support.skill_worlds import MOST, NUMBERS, World


def honest_context(random: Random, world: World) -> SkillContext:
    """Skills that run, and that can start next, with what their descriptions demand, as a robot
    tells of them.
    """
    running, ahead = (
        random.choices(sorted(world.skills), k=random.choice((0, 1, 1, 2, 3))) for _ in range(2)
    )
    return SkillContext(
        world.digest,
        tuple(_running(random, world, each) for each in running),
        tuple(_ahead(random, world, each) for each in ahead),
    )


def _ahead(random: Random, world: World, skill: str) -> RunningSkill:
    """Some arguments are not known yet, and none is nothing."""
    found = _running(random, world, skill)
    names = dict.fromkeys(each.parameter for each in found.arguments if each.value)
    known = {name for name in names if random.random() < 0.6}
    arguments = tuple(each for each in found.arguments if each.parameter in known)
    return RunningSkill(skill, arguments, is_ahead=True)


def _running(random: Random, world: World, skill: str) -> RunningSkill:
    arguments: list[SkillArgument] = []
    for parameter in world.skills[skill]["parameters"]:
        arguments += _argument(random, world, parameter)
    return RunningSkill(skill, tuple(arguments))


def _argument(
    random: Random, world: World, parameter: Mapping[str, Any]
) -> Iterator[SkillArgument]:
    """An argument: of an individual once for each class, none of them above another. There is none
    of what is optional, of what the skill has yet to find out, and of what is gone from the world.
    """
    name, type_ = parameter["name"], parameter["type"]
    if random.random() < 0.15:
        yield SkillArgument(name)
    elif type_ in world.classes:
        classes = [random.choice([each for each in world.classes if world.is_class(each, type_)])]
        others = sorted(world.classes)
        for each in random.sample(others, random.choice((0, 0, len(others)))):
            if not any(world.is_class(each, one) or world.is_class(one, each) for one in classes):
                classes.append(each)
        properties = tuple(_properties(random, world))
        for each in random.sample(classes, len(classes)):
            yield SkillArgument(name, "it", each, properties=properties)
    else:
        yield SkillArgument(name, "0", number=random.choice(NUMBERS))


def _properties(random: Random, world: World) -> Iterator[SkillProperty]:
    for each in world.properties:
        if random.random() < 0.7:
            yield SkillProperty(each, random.choice(NUMBERS))


def any_context(random: Random, world: World, others: Sequence[World] = ()) -> SkillContext:
    """Anything that may stand in a message: what an honest robot tells, often changed at one place
    to what it would not.
    """
    context = honest_context(random, world)
    for _ in range(random.choice((0, 1, 1, 2))):
        context = _changed(random, world, context, others)
    return context


def _changed(
    random: Random, world: World, context: SkillContext, others: Sequence[World]
) -> SkillContext:
    if random.random() < 0.15:
        digests = [each.digest for each in others] + ["", world.digest[:-1], f"{world.digest}\0"]
        return replace(context, digest=random.choice(digests))
    if random.random() < 0.1:
        return replace(context, is_ahead_known=False)
    if random.random() < 0.2 and context.ahead:
        ahead = list(context.ahead)
        place = random.randrange(len(ahead))
        ahead[place] = _changed_skill(random, world, ahead[place])
        return replace(context, ahead=tuple(ahead))
    if random.random() < 0.05:
        filling = crowd(random.choice((MOST, MOST + 1)), RunningSkill("none", is_ahead=True))
        return replace(context, ahead=filling)
    if random.random() < 0.1 or not context.running:
        filling = crowd(random.choice((MOST, MOST + 1, 500)) - 1, RunningSkill("none"))
        return replace(context, running=(*filling, *context.running[:1]))
    place = random.randrange(len(context.running))
    running = list(context.running)
    running[place] = _changed_skill(random, world, running[place])
    return replace(context, running=tuple(running))


def _changed_skill(random: Random, world: World, skill: RunningSkill) -> RunningSkill:
    if random.random() < 0.2 or not skill.arguments:
        names = [*world.skills, "", "S", skill.skill + "\0", "Größe"]
        return replace(skill, skill=random.choice(names))
    arguments = list(skill.arguments)
    place = random.randrange(len(arguments))
    match random.randrange(6):
        case 0:
            arguments.append(arguments[place])
        case 1:
            del arguments[place]
        case 2:
            arguments += crowd(MOST + random.randrange(2) - len(arguments), SkillArgument("P9"))
        case _:  # open: three of six
            arguments[place] = _changed_argument(random, world, arguments[place])
    return replace(skill, arguments=tuple(arguments))


def _changed_argument(random: Random, world: World, argument: SkillArgument) -> SkillArgument:
    properties = list(argument.properties) or [SkillProperty("kit.D0", 1.0)]
    match random.randrange(5):
        case 0:
            return replace(argument, type=random.choice([*world.classes, "", "kit.C", 'a"b\\c\n']))
        case 1:
            return replace(argument, number=random.choice(NUMBERS))
        case 2:
            properties.append(replace(properties[0], number=random.choice(NUMBERS)))
        case 3:
            properties = [*crowd(MOST + random.randrange(2) - 1, properties[0]), properties[-1]]
        case _:  # open: one of five
            return replace(argument, parameter=random.choice(("P0", "P1", "P2", "P3", "")))
    return replace(argument, properties=tuple(properties))
