"""Statements of conditions in the format of the export, with names of parameters and IRIs of the
ontology.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields
from typing import Any

from ezskiros.ontology.statements import (
    AnyOf,
    Generated,
    HasProperty,
    OfType,
    Relation,
    Specified,
    Statement,
    Value,
    ValueComparison,
)

_KINDS: Mapping[str, type[Any]] = {
    "relation": Relation,
    "comparison": ValueComparison,
    "property": HasProperty,
    "type": OfType,
    "specified": Specified,
    "generated": Generated,
}
"""The statements that have no parts."""
_NAMES = {made: kind for kind, made in _KINDS.items()}
_ANY = "any"
_OPERATORS = ("=", "<", ">", "<=", ">=")
_TYPES: Mapping[str, tuple[type, ...]] = {
    "bool": (bool,),
    "str": (str,),
    "Value": (str, int, float, bool),
}
"""The JSON types for the fields of a statement, by annotation."""
_FLOAT = "float"
_INFINITE = ({_FLOAT: "inf"}, {_FLOAT: "-inf"})
"""The numbers that JSON does not have."""
MOST_PARTS, MOST_LEVELS = 1000, 50
"""The most parts of a statement, including nested parts, and the most levels."""


def written(statement: Statement) -> dict[str, Any]:
    """A statement as a JSON object."""
    if isinstance(statement, AnyOf):
        parts = [written(each) for each in statement.parts]
        return {"kind": _ANY, "parts": parts, "is_true": statement.is_true}
    found = {"kind": _NAMES[type(statement)], **vars(statement)}
    if isinstance(statement, ValueComparison):
        found["value"] = _as_json(statement.value)
    return found


def _as_json(value: Value) -> Value | dict[str, str]:
    if isinstance(value, float) and math.isinf(value):
        return {_FLOAT: "inf" if value > 0 else "-inf"}
    return value


def statement_of(found: object) -> Statement:
    """The statement in a JSON object. Raises `ValueError` for an invalid object."""
    return _Reader().read(found)


class _Reader:
    def __init__(self) -> None:
        self._left = MOST_PARTS

    def read(self, found: object, level: int = 1) -> Statement:
        self._left -= 1
        if level > MOST_LEVELS:
            raise ValueError(f"it has more than {MOST_LEVELS} levels")
        if self._left < 0:
            raise ValueError(f"it has more than {MOST_PARTS:,} parts")
        if not isinstance(found, dict):
            raise ValueError("it is not an object")
        kind = found.get("kind")
        if kind == _ANY:
            return self._any(found, level)
        made = _KINDS.get(kind) if isinstance(kind, str) else None
        if made is None:
            raise ValueError(f"its `kind` is not one of {', '.join([*_KINDS, _ANY])}")
        known = {each.name: _checked(found, each.name, str(each.type)) for each in fields(made)}
        statement: Statement = made(**known)
        return statement

    def _any(self, found: Mapping[str, object], level: int) -> AnyOf:
        parts = found.get("parts")
        if not isinstance(parts, list) or not parts:
            raise ValueError("its `parts` are not a list of statements")
        is_true = _checked(found, "is_true", "bool")
        return AnyOf(tuple(self.read(each, level + 1) for each in parts), bool(is_true))


def _checked(found: Mapping[str, object], name: str, annotation: str) -> Value:
    value = found.get(name)
    if annotation == "Value" and value in _INFINITE:
        return math.inf if value == _INFINITE[0] else -math.inf
    types = _TYPES[annotation]
    if not isinstance(value, types) or (bool not in types and isinstance(value, bool)):
        raise ValueError(f"its `{name}` is missing or has the wrong type")
    if name == "operator" and value not in _OPERATORS:
        raise ValueError(f"its `operator` is not one of {' '.join(_OPERATORS)}")
    assert isinstance(value, (str, int, float, bool)), "the types of JSON"
    return value
