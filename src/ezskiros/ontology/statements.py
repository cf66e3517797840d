"""Statements about individuals: the data behind the conditions of skills.

Subjects and objects are the names of parameters; relations, properties and classes are IRIs.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, TypeAlias

Value: TypeAlias = "str | int | float | bool"
TURNED = {"<": ">=", ">": "<=", "<=": ">", ">=": "<"}
"""The comparison that holds if and only if another comparison of numbers does not."""


@dataclass(frozen=True)
class Relation:
    """Two individuals are related. With `is_abstract`, the statement is about their classes."""

    subject: str
    relation: str
    object: str
    is_true: bool = True
    is_abstract: bool = False


@dataclass(frozen=True)
class ValueComparison:
    """A data property has a value for which the comparison holds. `operator` is one of = < > <=
    >=.
    """

    subject: str
    property: str
    operator: str
    value: Value
    is_true: bool = True


@dataclass(frozen=True)
class HasProperty:
    """An individual has a value of a data property."""

    subject: str
    property: str
    is_true: bool = True


@dataclass(frozen=True)
class OfType:
    """An individual is of a class."""

    subject: str
    owl_class: str
    is_true: ClassVar[bool] = True


@dataclass(frozen=True)
class Specified:
    """A parameter has a value."""

    subject: str
    is_true: bool = True


@dataclass(frozen=True)
class Generated:
    """An individual exists in the world. As a post-condition, the skill creates or removes it."""

    subject: str
    is_true: bool = True


@dataclass(frozen=True)
class AnyOf:
    """At least one of these statements holds."""

    parts: tuple[Statement, ...]
    is_true: bool = True


Statement: TypeAlias = (
    "Relation | ValueComparison | HasProperty | OfType | Specified | Generated | AnyOf"
)


def negated(statement: Statement) -> Statement | None:
    """The negation; None for a type, because SkiROS2 has no negated types."""
    if isinstance(statement, OfType):
        return None
    return replace(statement, is_true=not statement.is_true)
