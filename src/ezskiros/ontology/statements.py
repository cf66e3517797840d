"""Statements about things: the data behind the conditions of skills.

Subjects and objects are the names of parameters; relations, properties and classes are IRIs.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, TypeAlias

Value: TypeAlias = "str | int | float | bool"
TURNED = {"<": ">=", ">": "<=", "<=": ">", ">=": "<"}
"""The comparison that holds of numbers when the other does not."""


@dataclass(frozen=True)
class Relation:
    """Two things are related; `is_abstract` asks for their classes instead."""

    subject: str
    relation: str
    object: str
    is_true: bool = True
    is_abstract: bool = False


@dataclass(frozen=True)
class Comparison:
    """A data property has a value that compares so; `operator` is one of = < > <= >=."""

    subject: str
    property: str
    operator: str
    value: Value
    is_true: bool = True


@dataclass(frozen=True)
class HasProperty:
    """A thing has some value of a data property."""

    subject: str
    property: str
    is_true: bool = True


@dataclass(frozen=True)
class OfType:
    """A thing is of a class."""

    subject: str
    owl_class: str
    is_true: ClassVar[bool] = True


@dataclass(frozen=True)
class Specified:
    """A parameter stands for a thing of the world."""

    subject: str
    is_true: bool = True


@dataclass(frozen=True)
class Generated:
    """A thing is in the world; as a post-condition it comes into it, or leaves it."""

    subject: str
    is_true: bool = True


@dataclass(frozen=True)
class AnyOf:
    """At least one of these holds."""

    parts: tuple[Statement, ...]
    is_true: bool = True


Statement: TypeAlias = (
    "Relation | Comparison | HasProperty | OfType | Specified | Generated | AnyOf"
)


def negated(statement: Statement) -> Statement | None:
    """The opposite; None for a type, of which SkiROS2 knows none."""
    if isinstance(statement, OfType):
        return None
    return replace(statement, is_true=not statement.is_true)
