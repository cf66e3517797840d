"""Random definitions of messages, random messages of them, and all that a rule could read there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from hypothesis import strategies as st
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_typestore
from rosbags.typesys.store import Typestore

from rossmarie.ir import Array, FieldKind, Slot
from rossmarie.recordings.extraction import WantedParts

TEXTS = ("docked", "höher", "")
TIME = "builtin_interfaces/msg/Time"
MOST_ELEMENTS = 4

_INTEGERS = {
    "byte": "int8",
    "char": "uint8",
    **{f"{sign}int{bits}": f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)},
}
_NUMBERS = (*_INTEGERS, "bool", "float32", "float64")


@dataclass(frozen=True)
class Described:
    """A message type, with those that it consists of."""

    store: Typestore
    name: str


# --- definitions -----------------------------------------------------------------------------


@st.composite
def described(draw: st.DrawFn) -> Described:
    """A type, of parts of parts."""
    names = [f"odd_msgs/msg/Type{index}" for index in range(draw(st.integers(1, 4)))]
    types: dict[str, Any] = {
        TIME: ([], [("sec", _base("int32")), ("nanosec", _base("uint32"))]),
    }
    for name in names:
        fields = draw(st.lists(_fields(list(types)), min_size=0, max_size=5))
        types[name] = ([], [(f"f{place}", field) for place, field in enumerate(fields)])
    store = get_typestore(Stores.EMPTY)
    store.register(types)
    return Described(store, names[-1])


def _fields(names: list[str]) -> st.SearchStrategy[Any]:
    """A field of one of the types, or of an array of it."""
    number = st.sampled_from(_NUMBERS).map(_base)
    text = st.just(_base("string"))
    part = st.sampled_from(names).map(lambda name: (Nodetype.NAME, name))
    one = st.one_of(number, number, text, part)
    fixed = st.tuples(st.just(Nodetype.ARRAY), st.tuples(one, st.integers(1, 3)))
    any_length = st.tuples(st.just(Nodetype.SEQUENCE), st.tuples(one, st.just(0)))
    return st.one_of(one, one, fixed, any_length)


def _base(name: str) -> Any:
    return (Nodetype.BASE, (name, 0))


# --- messages --------------------------------------------------------------------------------


@st.composite
def message(draw: st.DrawFn, of: Described, name: str | None = None) -> Any:
    """A message of a type."""
    name = name or of.name
    values = {
        field: draw(_value(of, description)) for field, description in of.store.fielddefs[name][1]
    }
    return of.store.types[name](**values)


def _value(of: Described, description: Any) -> st.SearchStrategy[Any]:
    kind, content = description
    if kind == Nodetype.NAME:
        return message(of, content)
    if kind == Nodetype.BASE:
        return _scalar(content[0])
    inner, count = content
    least, most = (count, count) if kind == Nodetype.ARRAY else (0, MOST_ELEMENTS)
    elements = st.lists(_value(of, inner), min_size=least, max_size=most)
    if inner[0] == Nodetype.BASE and inner[1][0] != "string":
        return elements.map(lambda values: np.array(values, _stored_as(inner[1][0])))
    return elements


def _scalar(name: str) -> st.SearchStrategy[Any]:
    if name == "string":
        return st.one_of(st.sampled_from(TEXTS), st.text(max_size=9))
    if name == "bool":
        return st.booleans()
    if name in _INTEGERS:
        limits = np.iinfo(_INTEGERS[name])
        return st.integers(int(limits.min), int(limits.max))
    return st.floats(width=32 if name == "float32" else 64)


def _stored_as(name: str) -> str:
    return _INTEGERS.get(name, name)


# --- what can be read ------------------------------------------------------------------------


def all_fields(of: Described) -> WantedParts:
    """Everything in a message that a rule could read; elements of arrays, and one beyond them."""
    slots: list[Slot] = []
    arrays: list[Array] = []
    for path, description in _paths(of.store, (Nodetype.NAME, of.name), ()):
        if description[0] in (Nodetype.ARRAY, Nodetype.SEQUENCE):
            arrays.append(Array(0, path, 1.0, 0.0, ""))
        else:
            kind = FieldKind.TEXT if description[1][0] == "string" else FieldKind.REAL
            slots.append(Slot(0, path, kind, 1.0, 0.0, ""))
    return WantedParts(dict(enumerate(slots)), dict(enumerate(arrays)))


def _paths(
    store: Typestore, description: Any, path: tuple[str | int, ...]
) -> Iterator[tuple[tuple[str | int, ...], Any]]:
    kind, content = description
    if kind == Nodetype.BASE:
        yield path, description
    elif kind == Nodetype.NAME:
        if content == TIME:
            yield path, description
        for field, inner in store.fielddefs[content][1]:
            if field != "structure_needs_at_least_one_member":
                yield from _paths(store, inner, (*path, field))
    else:
        if content[0][0] == Nodetype.BASE and content[0][1][0] != "string":
            yield path, description
        for index in (0, 1, 3):
            yield from _paths(store, content[0], (*path, index))
