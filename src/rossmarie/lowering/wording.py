"""The user's own words, on one line, for verdicts and generated comments; and units."""

from __future__ import annotations

import re

from dslkit.source import Span
from rossmarie.types import (
    Array,
    Boolean,
    Box,
    Entry,
    Interval,
    List,
    Message,
    Motion,
    Quantity,
    Quaternion,
    Region,
    Text,
    Type,
    Unknown,
    Unsupported,
    Vector,
)
from rossmarie.units import Unit

# A text literal stays unchanged; it has no escapes. White space and comments in succession become
# one blank.
_PIECE = re.compile(
    r"""(?P<literal>"[^"\n]*")|(?:\s|//[^\n]*|'''.*?''')+""",
    re.DOTALL,
)


def words(span: Span) -> str:
    """The text at a span, without comments and line breaks."""
    return _PIECE.sub(lambda piece: piece["literal"] or " ", span.text).strip()


def unit_of(type_: Type) -> Unit | None:
    """The unit in which a number, or a composite of numbers, is displayed."""
    match type_:
        case Quantity(unit=unit):
            return unit
        case (
            Vector(element=element)
            | Interval(element=element)
            | Box(element=element)
            | Array(element=Quantity() as element)
        ):
            return element.unit
        case (
            Boolean() | Text() | Quaternion() | Array() | List() | Region() | Motion() | Message()
            | Entry() | Unsupported() | Unknown()
        ):  # fmt: skip
            return None
