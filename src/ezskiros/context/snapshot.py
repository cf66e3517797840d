"""The message `skill_context_msgs/SkillContext` as plain data, made from the running skills."""

from __future__ import annotations

import enum
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ezskiros.engine.ahead import Ahead
from ezskiros.engine.running import Running
from ezskiros.engine.values import WorldIndividual
from ezskiros.engine.world import World
from ezskiros.export.vocabulary import name_in, name_of, type_of
from ezskiros.ontology import Ontology
from ezskiros.ontology.model import Model
from ezskiros.ontology.statements import Value
from ezskiros.skills.interface import Parameter
from ezskiros.skills.permits import Permission, PermittedIndividual
from ezskiros.skills.quantities import UNITS

MOST_AHEAD = 64
"""The most skills in a message. If there are more, the sender reports them as unknown."""


@dataclass(frozen=True)
class SkillProperty:
    """A number of an individual: the value of a data property with a unit, in SI."""

    property: str
    number: float


@dataclass(frozen=True)
class SkillArgument:
    """The value of a parameter. An individual has a `type`; an individual of several unrelated
    classes has an argument for each.
    """

    parameter: str
    value: str
    type: str = ""
    number: float = math.nan
    properties: tuple[SkillProperty, ...] = ()


@dataclass(frozen=True)
class SkillPermission:
    """A permission for one class of individuals, the `type`, which is empty for a speed. The
    `limit` is in SI, and NaN if there is no limit.
    """

    kind: str
    type: str
    limit: float


@dataclass(frozen=True)
class RunningSkill:
    """A running skill. `since` is its start time by the engine's clock, in seconds."""

    skill: str
    goal: str
    since: float
    arguments: tuple[SkillArgument, ...]
    permits: tuple[SkillPermission, ...]


@dataclass(frozen=True)
class SkillAhead:
    """A skill that can start next, with the arguments that are already known."""

    skill: str
    arguments: tuple[SkillArgument, ...]


@dataclass(frozen=True)
class Snapshot:
    """All running skills, in the order of their starts, and all that can start next; None if these
    are unknown. `digest` is the digest of the skills file.
    """

    digest: str
    running: tuple[RunningSkill, ...]
    ahead: tuple[SkillAhead, ...] | None = None


def plain(snapshot: Snapshot, start: float = 0.0) -> dict[str, Any]:
    """A snapshot as JSON data, with the field names of the message. NaN becomes null. Times are
    seconds since `start`.
    """
    return {
        "digest": snapshot.digest,
        "running": [
            {
                "skill": each.skill,
                "goal": each.goal,
                "since": round(each.since - start, 6),
                "arguments": [_plain_argument(argument) for argument in each.arguments],
                "permits": [
                    {"kind": one.kind, "type": one.type, "limit": _finite(one.limit)}
                    for one in each.permits
                ],
            }
            for each in snapshot.running
        ],
        "ahead": [
            {"skill": each.skill, "arguments": [_plain_argument(one) for one in each.arguments]}
            for each in snapshot.ahead or ()
        ],
        "is_ahead_known": snapshot.ahead is not None,
    }


def _plain_argument(found: SkillArgument) -> dict[str, Any]:
    return {
        "parameter": found.parameter,
        "value": found.value,
        "type": found.type,
        "number": _finite(found.number),
        "properties": [
            {"property": each.property, "number": _finite(each.number)} for each in found.properties
        ],
    }


def _finite(number: float) -> float | None:
    return number if math.isfinite(number) else None


class Snapshots:
    """Makes snapshots. The properties of each class are read from the ontology once."""

    def __init__(self, digest: str) -> None:
        self._digest = digest
        self._numbers: dict[tuple[int, tuple[str, ...]], Sequence[tuple[str, str, float]]] = {}

    def of(self, running: Iterable[Running], ahead: Iterable[Ahead] | None) -> Snapshot:
        """The snapshot of the running skills, and of those that can start next; None if these are
        unknown. Only the ticking thread may call this.
        """
        reported = None if ahead is None else tuple(dict.fromkeys(map(self._ahead, ahead)))
        if reported is not None and len(reported) > MOST_AHEAD:
            reported = None
        return Snapshot(self._digest, tuple(map(self._running, running)), reported)

    def _ahead(self, found: Ahead) -> SkillAhead:
        arguments = (
            argument
            for each in found.skill.parameters
            if each.name in found.values
            for argument in self._arguments(each, found.values[each.name])
        )
        return SkillAhead(found.skill.name, tuple(arguments))

    def _running(self, found: Running) -> RunningSkill:
        values = found.values()
        arguments = (
            argument
            for each in found.skill.parameters
            for argument in self._arguments(each, values.get(each.name))
        )
        permits = (one for each in found.skill.permits for one in _permitted(each, values))
        return RunningSkill(
            found.skill.name, found.goal, found.since, tuple(arguments), tuple(permits)
        )

    def _arguments(self, parameter: Parameter, value: object) -> Iterator[SkillArgument]:
        name = parameter.name
        if not isinstance(value, WorldIndividual):
            yield SkillArgument(name, _text(value), number=_number(value))
            return
        world: World = value._world  # noqa: SLF001
        properties = tuple(self.properties(world, value.iri))
        named = [name_in(world.ontology, each) for each in _classes(world, value.iri)]
        for each in named or [_declared(parameter)]:
            yield SkillArgument(name, _text(value), each, properties=properties)

    def properties(self, world: World, individual: str) -> Iterator[SkillProperty]:
        """The numbers of an individual, by its IRI. A property with several values is NaN."""
        classes = _classes(world, individual)
        key = id(world.ontology), tuple(classes)
        known = self._numbers.get(key)
        if known is None:
            known = self._numbers[key] = list(_numbers_of(world.ontology, classes))
        for iri, name, scale in known:
            values = {_number(each) for each in world.values(individual, iri)}
            if values:
                number = values.pop() * scale if len(values) == 1 else math.nan
                yield SkillProperty(name, number if math.isfinite(number) else math.nan)


def _classes(world: World, individual: str) -> list[str]:
    """The classes of an individual, without superclasses of its other classes; none if the
    individual no longer exists.
    """
    if not world.exists(individual):
        return []
    known, model = world.classes(individual), world.ontology.model
    return sorted(each for each in known if not _is_above_another(each, known, model))


def _is_above_another(iri: str, known: Iterable[str], model: Model) -> bool:
    """Say whether a class is a superclass of another one. Of two equivalent classes, the first one
    is not.
    """
    below = (each for each in known if each != iri and model.is_a(each, iri))
    return any(not model.is_a(iri, each) or each < iri for each in below)


def _numbers_of(ontology: Ontology, classes: Sequence[str]) -> Iterator[tuple[str, str, float]]:
    """The numeric data properties that individuals of some classes can have: the IRI, the name, and
    the SI value of one unit.
    """
    model = ontology.model
    above = frozenset().union(*map(model.above, classes)) if classes else frozenset()
    for iri, found in model.values.items():
        is_number = type_of(model, iri) != "str"
        if is_number and all(not union.isdisjoint(above) for union in model.domain(iri)):
            scale = UNITS[found.unit].si(1.0) if found.unit in UNITS else 1.0
            yield iri, name_in(ontology, iri), scale


def _permitted(found: Permission, values: Mapping[str, Any]) -> Iterator[SkillPermission]:
    """A permission for each individual; none for a parameter without a value."""
    limit = found.limit.si if found.limit else math.nan
    if not found.individuals:
        yield SkillPermission(found.kind.value, "", limit)
    for each in found.individuals:
        name = _permitted_class(each, values)
        if name is not None:
            yield SkillPermission(found.kind.value, name, limit)


def _permitted_class(found: PermittedIndividual, values: Mapping[str, Any]) -> str | None:
    """The class for which an individual has a permission. If the individual has several classes,
    one is enough: the permission is for individuals of all of them.
    """
    if found.parameter is None:
        return name_of(found.owl_class)
    value = values.get(found.parameter)
    if not isinstance(value, WorldIndividual):
        return None
    world: World = value._world  # noqa: SLF001
    classes = _classes(world, value.iri)
    return name_in(world.ontology, classes[0]) if classes else None


def _declared(parameter: Parameter) -> str:
    """The class of a parameter, for an individual that no longer exists."""
    return name_of(parameter.type) if parameter.iri is not None else ""  # type: ignore[arg-type]


def _text(value: object) -> str:
    """A value as valid Unicode text; empty if there is no value."""
    if value is None:
        return ""
    if isinstance(value, enum.Enum):
        return value.name
    text = str(value).lower() if isinstance(value, bool) else str(value)
    return text.encode("utf-8", "replace").decode()


def _number(value: Value | object) -> float:
    """A number, or a boolean as 0 or 1; NaN for any other value."""
    if not isinstance(value, (bool, int, float)) or isinstance(value, enum.Enum):
        return math.nan
    try:
        return float(value)
    except OverflowError:
        return math.nan
