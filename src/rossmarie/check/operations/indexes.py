"""Elements that are chosen by an index: by their place, or by their name."""

from __future__ import annotations

from dslkit.diagnostics import Diagnostic
from dslkit.source import Span
from rossmarie.check.operations.errors import ElementsWithoutNames, NotAnArray
from rossmarie.check.wording.describe import describe
from rossmarie.types import (
    Array,
    Boolean,
    Box,
    Entry,
    Interval,
    Message,
    Quantity,
    Quaternion,
    Text,
    Type,
    Unknown,
    Unsupported,
    Vector,
)


def element_of(owner: Type, index: int | str) -> Type | None:
    """The type of an element, by its place or its name; None if there are no such elements. Of a
    message with names the name stands for all of its arrays.
    """
    match owner:
        case Array(element=element, names=names):
            return element if isinstance(index, int) or names is not None else None
        case Message(names=str()) if isinstance(index, str):
            return Entry(owner)
        case (
            Boolean() | Text() | Quantity() | Vector() | Quaternion() | Interval() | Box()
            | Message() | Entry() | Unsupported() | Unknown()
        ):  # fmt: skip
            return None


def no_element(owner: Type, index: int | str, span: Span, text: str) -> Diagnostic:
    """The finding that something has no elements to choose by an index, or none with names."""
    if isinstance(index, str) and isinstance(owner, Array | Message):
        unnamed = ElementsWithoutNames(text=text)
        is_array = isinstance(owner, Array)
        return unnamed.at(span, help=unnamed.Place(text=text) if is_array else unnamed.Fields())
    finding = NotAnArray(purpose="an index", found=describe(owner))
    if isinstance(owner, Vector):
        return finding.at(span, help=finding.Components(text=text))
    if isinstance(owner, Message) and owner.names is not None:
        return finding.at(span, help=finding.ByName(text=text))
    return finding.at(span, help=finding.NoIndex())
