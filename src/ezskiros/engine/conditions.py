"""Conditions of skills in a world model: their truth values, the changes that make them true, and
the reasons why they are false.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator, Mapping

from ezskiros.check.inference import names
from ezskiros.engine.world import World
from ezskiros.ontology.statements import (
    TURNED,
    AnyOf,
    Generated,
    HasProperty,
    OfType,
    Relation,
    Specified,
    Statement,
    Value,
    ValueComparison,
    negated,
)

_COMPARED: dict[str, Callable[[Value, Value], bool]] = {
    "=": operator.eq,
    "<": operator.lt,
    ">": operator.gt,
    "<=": operator.le,
    ">=": operator.ge,
}

Bound = Mapping[str, str]
"""The individuals of parameters, as IRIs."""


def holds(statement: Statement, bound: Bound, world: World) -> bool:
    """Say whether a condition holds. If a parameter has no value, only negated conditions hold."""
    return _is_so(statement, bound, world) == statement.is_true


def _is_so(statement: Statement, bound: Bound, world: World) -> bool:
    """Say whether a condition holds without its `~`."""
    if isinstance(statement, AnyOf):
        return any(holds(part, bound, world) for part in statement.parts)
    subject = bound.get(statement.subject)
    if subject is None:
        return False
    match statement:
        case Relation():
            return _are_related(statement, subject, bound.get(statement.object), world)
        case ValueComparison(property=iri, operator=sign, value=value):
            return any(_compares(sign, each, value) for each in world.values(subject, iri))
        case HasProperty(property=iri):
            return bool(world.values(subject, iri))
        case OfType(owl_class=owl_class):
            return world.is_a(subject, owl_class)
        case Generated():
            return world.exists(subject)
        case Specified():
            return True


def _are_related(said: Relation, subject: str, other: str | None, world: World) -> bool:
    if other is None:
        return False
    if not said.is_abstract:
        return world.are_related(subject, said.relation, other)
    return any(
        world.are_related(one, said.relation, another)
        for one in world.classes(subject)
        for another in world.classes(other)
    )


def _compares(sign: str, value: Value, other: Value) -> bool:
    """Say whether a comparison of two values holds. Unordered values only support `=`."""
    try:
        return _COMPARED[sign](value, other)
    except TypeError:
        return False


# --- changes --------------------------------------------------------------------------------------


def make(statement: Statement, bound: Bound, world: World) -> None:
    """Make a condition true, or a condition with `~` false.

    The simplest change is made: for `a | b` the first alternative, for `Weight < 3` a value that is
    smaller by one. Conditions about parameters without a value change nothing.
    """
    if isinstance(statement, AnyOf):
        parts = statement.parts[:1] if statement.is_true else map(negated, statement.parts)
        for part in parts:
            if part is not None:
                make(part, bound, world)
        return
    subject = bound.get(statement.subject)
    if subject is None or holds(statement, bound, world):
        return
    match statement:
        case Relation():
            _make_related(statement, subject, bound.get(statement.object), world)
        case ValueComparison():
            _make_compare(statement, subject, world)
        case HasProperty(property=iri, is_true=is_true):
            if is_true:
                world.set_some_value(subject, iri)
            else:
                world.unset(subject, iri)
        case OfType(owl_class=owl_class):
            world.set_class(subject, owl_class)
        case Generated(is_true=False):
            world.remove(subject)
        case Specified() | Generated():
            pass


def _make_related(said: Relation, subject: str, other: str | None, world: World) -> None:
    if other is None:
        return
    if said.is_true:
        world.relate(subject, said.relation, other)
    else:
        world.unrelate(subject, said.relation, other)


def _make_compare(said: ValueComparison, subject: str, world: World) -> None:
    if not said.is_true and said.operator == "=":
        world.unset(subject, said.property)
        return
    sign = said.operator if said.is_true else TURNED[said.operator]
    world.set_value(subject, said.property, _value_so(sign, said.value))


def _value_so(sign: str, value: Value) -> Value:
    """A value for which the comparison with another value holds."""
    if sign in ("=", "<=", ">=") or isinstance(value, (str, bool)):
        return value
    return value - 1 if sign == "<" else value + 1


# --- reasons --------------------------------------------------------------------------------------


def reason(statement: Statement, bound: Bound, world: World) -> str:
    """Report the facts of the world that contradict a condition."""
    stands_for = (
        f"{name} is {world.spelled(bound[name])}" if name in bound else f"{name} has no value"
        for name in dict.fromkeys(names(statement))
    )
    return "; ".join([*stands_for, *_facts(statement, bound, world)])


def _facts(statement: Statement, bound: Bound, world: World) -> Iterator[str]:
    match statement:
        case AnyOf(parts=parts):
            for part in parts:
                yield from _facts(part, bound, world)
        case Relation(subject=subject, relation=relation, object=other) if subject not in bound:
            if other in bound:
                relating = world.relating(relation, bound[other])
                found = ", ".join(map(world.spelled, relating)) or "nothing"
                yield f"{found} {world.spelled(relation)} {other}"
        case _ if statement.subject not in bound:
            return
        case Relation(subject=subject, relation=relation):
            related = world.related(bound[subject], relation)
            found = ", ".join(map(world.spelled, related)) or "nothing"
            yield f"{subject} {world.spelled(relation)} {found}"
        case (
            ValueComparison(subject=subject, property=iri)
            | HasProperty(subject=subject, property=iri)
        ):
            found = ", ".join(map(repr, world.values(bound[subject], iri))) or "no value"
            yield f"{subject} {world.spelled(iri)}: {found}"
        case OfType(subject=subject):
            found = ", ".join(map(world.spelled, world.classes(bound[subject]))) or "nothing"
            yield f"{subject} has the classes {found}"
        case Generated(subject=subject, is_true=is_true):
            yield f"{subject} is {'not ' if is_true else ''}in the world"
        case Specified():
            return
