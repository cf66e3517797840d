"""The part of JSON Schema that this project's schemas use, to check files without a library.

A keyword that is not known here is refused, so that no part of a schema goes unchecked.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any

_TYPES: Mapping[str, Callable[[Any], bool]] = {
    "object": lambda value: isinstance(value, dict),
    "array": lambda value: isinstance(value, list),
    "string": lambda value: isinstance(value, str),
    "integer": lambda value: type(value) is int,
    "number": lambda value: type(value) in (int, float),
    "boolean": lambda value: type(value) is bool,
    "null": lambda value: value is None,
}
_NOTES = {"$schema", "title", "$defs"}


def faults(value: Any, schema: Mapping[str, Any]) -> list[str]:
    """The places where a value does not match a schema, with the reasons."""
    return list(_faults(value, schema, schema, "$"))


def _faults(
    value: Any, schema: Mapping[str, Any], whole: Mapping[str, Any], at: str
) -> Iterator[str]:
    for keyword, wanted in schema.items():
        if keyword in _NOTES:
            continue
        yield from _CHECKS[keyword](value, wanted, schema, whole, at)


Check = Callable[[Any, Any, Mapping[str, Any], Mapping[str, Any], str], Iterator[str]]


def _holds(test: Callable[[Any, Any], bool]) -> Check:
    def check(value: Any, wanted: Any, _s: Any, _w: Any, at: str) -> Iterator[str]:
        if not test(value, wanted):
            yield f"{at}: {value!r} is not as {wanted!r} says"

    return check


def _is_number(value: Any) -> bool:
    return type(value) in (int, float)


def _is_of_type(value: Any, wanted: Any) -> bool:
    names = wanted if isinstance(wanted, list) else [wanted]
    return any(_TYPES[name](value) for name in names)


def _reference(value: Any, wanted: str, _schema: Any, whole: Any, at: str) -> Iterator[str]:
    found = whole
    for part in wanted.removeprefix("#/").split("/"):
        found = found[part]
    yield from _faults(value, found, whole, at)


def _any_of(value: Any, wanted: Any, _schema: Any, whole: Any, at: str) -> Iterator[str]:
    tried = [list(_faults(value, each, whole, at)) for each in wanted]
    if all(tried):
        yield from min(tried, key=len)


def _properties(value: Any, wanted: Any, schema: Any, whole: Any, at: str) -> Iterator[str]:
    if isinstance(value, dict):
        for name in value.keys() & wanted.keys():
            yield from _faults(value[name], wanted[name], whole, f"{at}.{name}")


def _additional(value: Any, wanted: Any, schema: Any, whole: Any, at: str) -> Iterator[str]:
    if isinstance(value, dict):
        for name in value.keys() - schema.get("properties", {}).keys():
            if wanted is False:
                yield f"{at}: {name!r} is not known"
            else:
                yield from _faults(value[name], wanted, whole, f"{at}.{name}")


def _items(value: Any, wanted: Any, _schema: Any, whole: Any, at: str) -> Iterator[str]:
    if isinstance(value, list):
        for number, each in enumerate(value):
            yield from _faults(each, wanted, whole, f"{at}[{number}]")


_CHECKS: Mapping[str, Check] = {
    "type": _holds(_is_of_type),
    "const": _holds(lambda value, wanted: type(value) is type(wanted) and value == wanted),
    "enum": _holds(lambda value, wanted: value in wanted),
    "pattern": _holds(
        lambda value, wanted: not isinstance(value, str) or re.search(wanted, value) is not None
    ),
    "minimum": _holds(lambda value, wanted: not _is_number(value) or value >= wanted),
    "exclusiveMinimum": _holds(lambda value, wanted: not _is_number(value) or value > wanted),
    "required": _holds(
        lambda value, wanted: not isinstance(value, dict) or value.keys() >= set(wanted)
    ),
    "$ref": _reference,
    "anyOf": _any_of,
    "properties": _properties,
    "additionalProperties": _additional,
    "items": _items,
    "minItems": _holds(lambda value, wanted: not isinstance(value, list) or len(value) >= wanted),
    "maxItems": _holds(lambda value, wanted: not isinstance(value, list) or len(value) <= wanted),
    "minLength": _holds(lambda value, wanted: not isinstance(value, str) or len(value) >= wanted),
}
