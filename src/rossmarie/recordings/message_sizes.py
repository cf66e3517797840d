"""The cost of messages of a type: a few bytes of a message, or of a definition, can represent any
number of objects.

rosbags generates Python code for a definition, with a line for each element of an array of fixed
length, and creates an object for each element of a message. This module limits both in advance.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from rosbags.interfaces import Nodetype
from rosbags.interfaces.typing import Constdefs, Fielddefs
from rosbags.typesys import TypesysError

from rossmarie.recordings.limits import (
    DEEPEST_TYPE,
    LONGEST_FIXED_ARRAY,
    MOST_ELEMENTS,
    MOST_FIELDS,
)

Definitions = Mapping[str, tuple[Constdefs, Fielddefs]]

_TEXTS = ("string", "wstring")
_COUNT = 4
"""The bytes of the length before a text or an array."""
_BITS = re.compile(r"\d+$")


class Sizes:
    """The sizes of types that are defined together.

    Each method raises `TypesysError` for a type that is beyond a limit.
    """

    def __init__(self, definitions: Definitions) -> None:
        self._definitions = definitions
        self._known: dict[str, tuple[int, int]] = {}
        self._elements: list[int] = []

    def check(self, name: str) -> None:
        """Check a type, and the types that it contains."""
        self._type(name, 0)

    def largest_message(self, name: str) -> int | None:
        """The most bytes that a message may have, so that its arrays of texts and messages do not
        have too many elements; None if it has no such array.
        """
        self._type(name, 0)
        return min(self._elements) * MOST_ELEMENTS if self._elements else None

    def _type(self, name: str, depth: int) -> tuple[int, int]:
        """The least bytes, and the number of fields, of a type."""
        if depth > DEEPEST_TYPE:
            raise TypesysError(f"types are nested more than {DEEPEST_TYPE} deep")
        if name not in self._known:
            fields = self._definitions[name][1] if name in self._definitions else []
            parts = [self._field(description, depth) for _, description in fields]
            number = 1 + sum(count for _, count in parts)
            if number > MOST_FIELDS:
                raise TypesysError(f"`{name}` has more than {MOST_FIELDS} fields")
            self._known[name] = sum(size for size, _ in parts), number
        return self._known[name]

    def _field(self, description: Any, depth: int) -> tuple[int, int]:
        """The least bytes, and the number of fields, of a field. `description` is a `FieldDesc` of
        rosbags, whose type is too general.
        """
        kind, what = description
        if kind is Nodetype.NAME:
            return self._type(str(what), depth + 1)
        if kind is Nodetype.BASE:
            return _bytes(str(what[0])), 1
        inner, number = what[0], int(what[1])
        size, fields = self._field(inner, depth)
        is_fixed = kind is Nodetype.ARRAY
        if inner[0] is Nodetype.BASE and inner[1][0] not in _TEXTS:
            return (number * size if is_fixed else _COUNT), 1
        if size == 0:
            raise TypesysError("there is an array of messages without fields")
        self._elements.append(size)
        if is_fixed and number > LONGEST_FIXED_ARRAY:
            raise TypesysError(f"an array has {number} elements, more than {LONGEST_FIXED_ARRAY}")
        return (number * size, number * fields) if is_fixed else (_COUNT, fields)


def _bytes(base: str) -> int:
    """The least bytes of a text or a number: `float64` has 8, `bool` 1."""
    bits = _BITS.search(base)
    return _COUNT if base in _TEXTS else int(bits[0]) // 8 if bits else 1
