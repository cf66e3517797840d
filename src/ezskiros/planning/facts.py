"""Facts about a world model that are true or false for individuals, for planners.

Facts about relations and properties of the ontology are read from a world model and changed in it.
"""

from __future__ import annotations

import enum
import operator
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from ezskiros.engine.world import World
from ezskiros.ontology.model import Model
from ezskiros.ontology.statements import Value

EVERYTHING = "*"
"""In an effect, instead of an individual: all individuals except that of the next effect."""
_COMPARED: dict[str, Callable[[Value, Value], bool]] = {
    "=": operator.eq,
    "<": operator.lt,
    ">": operator.gt,
    "<=": operator.le,
    ">=": operator.ge,
}


class About(enum.Enum):
    """The subject of a fact."""

    RELATION = "relation"
    COMPARISON = "comparison"
    PROPERTY = "property"
    CLASS = "class"
    GONE = "gone"


@dataclass(frozen=True)
class Fluent:
    """A fact about individuals: about two for a relation, otherwise about one."""

    about: About
    iri: str = ""
    operator: str = ""
    value: Value = ""

    def compares(self, value: Value) -> bool:
        """Say whether a value of the property satisfies the comparison."""
        try:
            return _COMPARED[self.operator](value, self.value)
        except TypeError:  # unordered values
            return False


@dataclass(frozen=True)
class FluentLiteral:
    """A fluent of individuals or parameters that is true or false."""

    fluent: Fluent
    arguments: tuple[str, ...]
    is_true: bool = True

    def negated(self) -> FluentLiteral:
        """The negated literal."""
        return replace(self, is_true=not self.is_true)

    def bound(self, individuals: dict[str, str]) -> FluentLiteral:
        """The literal with individuals instead of parameters."""
        return replace(
            self, arguments=tuple(individuals.get(each, each) for each in self.arguments)
        )


Clause = tuple[FluentLiteral, ...]
"""At least one of these literals holds."""


def is_so(literal: FluentLiteral, world: World) -> bool:
    """Say whether a literal holds in a world."""
    fluent, subject = literal.fluent, literal.arguments[0]
    match fluent.about:
        case About.RELATION:
            found = world.are_related(subject, fluent.iri, literal.arguments[1])
        case About.COMPARISON:
            found = any(map(fluent.compares, world.values(subject, fluent.iri)))
        case About.PROPERTY:
            found = bool(world.values(subject, fluent.iri))
        case About.CLASS:
            found = world.is_a(subject, fluent.iri)
        case About.GONE:
            found = not world.exists(subject)
    return found == literal.is_true


def make_so(literal: FluentLiteral, world: World) -> None:
    """Make a literal true in a world. The world determines the consequences."""
    fluent, subject = literal.fluent, literal.arguments[0]
    match fluent.about:
        case About.RELATION:
            change = world.relate if literal.is_true else world.unrelate
            change(subject, fluent.iri, literal.arguments[1])
        case About.COMPARISON:
            if literal.is_true:
                world.set_value(subject, fluent.iri, fluent.value)
            elif fluent.value in world.values(subject, fluent.iri):
                world.unset(subject, fluent.iri)
        case About.PROPERTY:
            if literal.is_true:
                world.set_some_value(subject, fluent.iri)
            else:
                world.unset(subject, fluent.iri)
        case About.CLASS:
            pass
        case About.GONE:
            if literal.is_true:
                world.remove(subject)


def implied(relation: str, model: Model) -> Sequence[tuple[str, bool]]:
    """The relations that a relation implies, starting with itself, each with whether it has the
    same direction.
    """
    found: dict[tuple[str, bool], None] = {}
    left = [(relation, True)]
    while left:
        each = left.pop()
        if each not in found:
            found[each] = None
            left += _next(*each, model)
    return list(found)


def _next(relation: str, is_forward: bool, model: Model) -> Iterator[tuple[str, bool]]:
    declared = model.relations.get(relation)
    if declared is None:
        return
    yield from ((each, is_forward) for each in declared.parents)
    yield from ((each, not is_forward) for each in declared.inverses)
    yield from (
        (iri, not is_forward)
        for iri, other in model.relations.items()
        if relation in other.inverses
    )
    if declared.is_symmetric:
        yield relation, not is_forward


def spelled(literal: FluentLiteral, model: Model, shown: Callable[[str], str] = str) -> str:
    """A fact for messages, such as `skiros:Gripper-1 skiros:contain skiros:Product-4`."""
    fluent, names = literal.fluent, [shown(each) for each in literal.arguments]
    iri = model.short(fluent.iri)
    match fluent.about:
        case About.RELATION:
            text = f"{names[0]} {iri} {names[1]}"
        case About.COMPARISON:
            text = f"{names[0]} {iri} {fluent.operator} {fluent.value!r}"
        case About.PROPERTY:
            text = f"{names[0]} {iri}"
        case About.CLASS:
            text = f"{names[0]} is a {iri}"
        case About.GONE:
            text = f"{names[0]} no longer exists"
    return text if literal.is_true else f"not ({text})"
