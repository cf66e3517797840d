"""Random skills files, queries about them, and the answers that S58 and S67 of
docs/explanation/semantics.md give: from the file and the message alone, by nothing of ours.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from random import Random
from typing import Any

from rossmarie import ir
from rossmarie.ir.skills import RunningSkill, SkillContext
from support.compiled import machine_of

MOST = 64
"""The maximum length of each list in a message, by the message definition."""

NUMBERS = (0.0, 1.0, 1.0, 0.25, -1.0, -0.0, 7.25, 2.5e-308, math.inf, math.nan)
_PLAIN = ("float", "int", "bool", "str", "enum")
_ASKED = ("float", "int", "bool")


@dataclass(frozen=True)
class Query:
    """A query as rules write it: for a boolean the classes of parameters, in `limits`, and
    whether it is about what can start next (`is_ahead`); for a number its `parameter`, and the
    `property` of the individual that is it. `is_boolean` tells that the number is one of a boolean.
    """

    skill: str
    limits: tuple[tuple[str, str], ...] = ()
    parameter: str | None = None
    property: str | None = None
    is_boolean: bool = False
    is_ahead: bool = False


class World:
    """A skills file."""

    def __init__(self, content: Mapping[str, Any]) -> None:
        self.content = content
        self.digest: str = content["digest"]
        self.skills = {each["name"]: each for each in content["skills"]}
        self.classes = {each["name"]: each for each in content["classes"]}
        self.properties = {each["name"]: each for each in content["properties"]}

    def is_skill(self, name: str, wanted: str) -> bool:
        """Say whether a skill is another one, or is derived from it."""
        return _leads(self.skills, name, wanted, set())

    def is_class(self, name: str, wanted: str) -> bool:
        """Say whether a class is another one, or is derived from it."""
        return _leads(self.classes, name, wanted, set())

    def individuals(self, skill: str) -> dict[str, dict[str, Any]]:
        """The parameters of a skill that are individuals."""
        parameters = self.skills[skill]["parameters"]
        return {each["name"]: each for each in parameters if each["type"] in self.classes}

    def may_be(self, type_: str) -> list[str]:
        """The classes that some individual of a class may have as well."""
        return [
            name
            for name in self.classes
            if any(self.is_class(each, type_) and self.is_class(each, name)
                   for each in self.classes)
        ]  # fmt: skip

    # --- S58 -------------------------------------------------------------------------------------

    def answer(self, query: Query, context: SkillContext) -> float:
        """The answer that S58 and S67 say."""
        if context.digest != self.digest or not _is_as_defined(context):
            return math.nan
        if query.is_ahead:
            if not context.is_ahead_known:
                return math.nan
            return float(any(self._may_be_done(query, each) for each in context.ahead))
        if query.parameter is None:
            return float(any(self._is_done(query, each) for each in context.running))
        asked = [each for each in context.running if self.is_skill(each.skill, query.skill)]
        return _one_of(query, asked[0]) if len(asked) == 1 else math.nan

    def _is_done(self, query: Query, running: RunningSkill) -> bool:
        if not self.is_skill(running.skill, query.skill):
            return False
        for parameter, wanted in query.limits:
            classes = [each.type for each in running.arguments if each.parameter == parameter]
            if not any(self.is_class(each, wanted) for each in classes):
                return False
        return True

    def _may_be_done(self, query: Query, ahead: RunningSkill) -> bool:
        reported = {each.parameter for each in ahead.arguments}
        limits = tuple(each for each in query.limits if each[0] in reported)
        return self._is_done(replace(query, limits=limits), ahead)


def _leads(known: Mapping[str, Any], name: str, wanted: str, passed: set[str]) -> bool:
    if name == wanted:
        return True
    if name in passed or name not in known:
        return False
    passed.add(name)
    return any(_leads(known, each, wanted, passed) for each in known[name]["parents"])


def _is_as_defined(context: SkillContext) -> bool:
    lists: list[Sequence[object]] = [context.running, context.ahead]
    skills = (*context.running, *context.ahead)
    lists += [each.arguments for each in skills]
    lists += [each.properties for skill in skills for each in skill.arguments]
    return max(map(len, lists)) <= MOST


def _one_of(query: Query, running: RunningSkill) -> float:
    """The number, however often it is reported: of an individual once for each of its classes."""
    found = [each for each in running.arguments if each.parameter == query.parameter]
    numbers = [each.number for each in found]
    if query.property is not None:
        numbers = [
            one.number
            for each in found
            for one in each.properties
            if one.property == query.property
        ]
    if not numbers or any(each != numbers[0] for each in numbers):
        return math.nan
    return math.nan if query.is_boolean and numbers[0] not in (0, 1) else numbers[0]


# --- skills files -----------------------------------------------------------------------------


def random_world(random: Random) -> World:
    """Classes and skills that are derived over several levels, from several others, and classes
    that mean the same.
    """
    classes: list[dict[str, Any]] = []
    is_small = random.random() < 0.4  # then queries meet at the same classes
    for number in range(3 if is_small else random.randint(3, 8)):
        above = [each["name"] for each in classes]
        name = f"{random.choice(('kit', 'toys'))}.C{number}"
        count = min(len(above), random.choice((0, 1, 2, 2)))
        classes.append(_derived(name, random.sample(above, count)))
    if random.random() < 0.25:
        one, other = random.sample(classes, 2)
        one["parents"] = [*one["parents"], other["name"]]  # at times a circle: they mean the same
    names = [each["name"] for each in classes]
    properties = [
        {
            "name": f"kit.D{number}",
            "type": random.choice(_ASKED),
            "of": random.sample(names, random.randint(1, 2)),
            "unit": None,
            "place": None,
        }
        for number in range(random.randint(1, 3))
    ]
    skills: list[dict[str, Any]] = []
    for number in range(1 if is_small else random.randint(2, 6)):
        skills.append(_skill(random, number, skills, names))
    return World({
        "format": "ezskiros/skills",
        "version": 1,
        "digest": f"{random.getrandbits(256):064x}",
        "sources": [],
        "context": {
            "topic": "/skill_context", "type": "skill_context_msgs/SkillContext", "period": 0.1,
        },
        "classes": [{**each, "iri": f"http://example.org/{each['name']}"} for each in classes],
        "properties": properties,
        "skills": skills,
    })  # fmt: skip


def _few(random: Random) -> int:
    return random.choice((0, 1, 1, 1, 2))


def _derived(name: str, parents: Sequence[str]) -> dict[str, Any]:
    return {"name": name, "parents": list(parents), "place": None}


def _skill(
    random: Random, number: int, others: Sequence[dict[str, Any]], classes: Sequence[str]
) -> dict[str, Any]:
    """A skill that has the parameters of those that it is derived from, and some of its own."""
    parents = random.sample(others, min(len(others), _few(random)))
    parameters = {one["name"]: one for each in parents for one in each["parameters"]}
    for name in random.sample(("P0", "P1", "P2", "P3"), random.randint(0, 3)):
        type_ = random.choice(classes) if random.random() < 0.7 else random.choice(_PLAIN)
        parameters.setdefault(name, {
            "name": name, "key": name, "kind": "given", "type": type_, "is_output": False,
            "default": None, "place": None,
        })  # fmt: skip
    return {
        **_derived(f"S{number}", [each["name"] for each in parents]),
        "doc": "",
        "parameters": list(parameters.values()),
        "conditions": {"pre": [], "hold": [], "post": []},
        "trees": [],
        "permits": [],
        "uses": [],
    }


# --- queries -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Asked:
    """A machine that asks, and what each of its slots asks."""

    world: World
    machine: ir.Machine
    queries: tuple[Query, ...]

    def steps(self) -> tuple[ir.SkillStep, ...]:
        """The queries as the machine has them."""
        steps = (slot.path[0] for slot in self.machine.slots)
        return tuple(each for each in steps if isinstance(each, ir.Doing | ir.Quantity))


def asked_of(random: Random, world: World, folder: Path) -> Asked:
    """The machine of rules that ask some queries about a skills file, which is written."""
    file = folder / f"{world.digest[:12]}.json"
    file.write_text(json.dumps(world.content), encoding="utf-8")
    lines = [f'skills "{file}" timeout 1 sec;', "action stop;"]
    words: dict[str, Query] = {}
    skills = sorted(world.skills)
    if random.random() < 0.5:  # queries about one skill are distinguished by classes alone
        skills = [random.choice(skills)]
    for number in range(random.randint(2, 5)):
        query = random_query(random, world, skills)
        text = _text(random, query, world)
        if text in words:
            continue
        words[text] = query
        asked = text
        if query.parameter is not None:
            lines.append(f"input n{number} = doing {text};")
            asked = f"n{number}" if query.is_boolean else f"n{number} > 0.5"
        lines.append(f"rule r{number}: if {asked} then {{ stop; }};")
    machine = machine_of("\n".join(lines))
    queries = tuple(words[str(slot.path[0])] for slot in machine.slots)
    return Asked(world, machine, queries)


def random_query(random: Random, world: World, skills: Sequence[str]) -> Query:
    """A query that rules may ask about one of some skills."""
    skill = random.choice(skills)
    numbers = list(_numbers(world, skill))
    if numbers and random.random() < 0.4:
        return random.choice(numbers)
    limits = []
    for name, parameter in world.individuals(skill).items():
        if random.random() < 0.6:
            type_ = parameter["type"]
            possible = world.may_be(type_)
            beside = [
                each
                for each in possible
                if not world.is_class(each, type_) and not world.is_class(type_, each)
            ]
            limits.append((name, random.choice(random.choice((possible, beside or possible)))))
    random.shuffle(limits)
    return Query(skill, tuple(limits), is_ahead=random.random() < 0.3)


def _numbers(world: World, skill: str) -> Iterator[Query]:
    individuals = world.individuals(skill)
    for parameter in world.skills[skill]["parameters"]:
        name, type_ = parameter["name"], parameter["type"]
        if type_ in _ASKED:
            yield Query(skill, (), name, None, type_ == "bool")
        for each in world.properties.values() if name in individuals else ():
            if any(world.is_class(one, type_) or world.is_class(type_, one) for one in each["of"]):
                yield Query(skill, (), name, each["name"], each["type"] == "bool")


def _text(random: Random, query: Query, world: World) -> str:
    """The query in the words of rules; that of a number without `doing`."""
    if query.parameter is not None:
        behind = "" if query.property is None else f".{query.property.rpartition('.')[2]}"
        return f"{query.skill}.{query.parameter}{behind}"
    limits = [f"{name}: {_class(random, wanted, world)}" for name, wanted in query.limits]
    word = "ahead" if query.is_ahead else "doing"
    return f"{word} {query.skill}" + (f"({', '.join(limits)})" if limits else "")


def _class(random: Random, name: str, world: World) -> str:
    """A class with or without its namespace, which goes without saying where no two are alike."""
    return random.choice((name, name.rpartition(".")[2]))
