"""Elements chosen by an index: by their position, or by their name."""

from __future__ import annotations

from dslkit.diagnostics import Diagnostic, DidYouMean, Edit, Fix, listed
from dslkit.source import Span
from rossmarie.check.operations.errors import ElementsWithoutNames, NotAnArray, UnlistedName
from rossmarie.check.wording.describe import describe
from rossmarie.check.wording.suggestions import near_name
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


def element_of(owner: Type, index: int | str) -> Type | None:
    """The type of an element, chosen by its position or its name; None if there are no such
    elements. In a message with names, the name selects an element of each of its arrays.
    """
    match owner:
        case Array(element=element, names=names):
            is_there = index in names if isinstance(names, tuple) else names is not None
            return element if isinstance(index, int) or is_there else None
        case Message(names=str()) if isinstance(index, str):
            return Entry(owner)
        case (
            Boolean() | Text() | Quantity() | Vector() | Quaternion() | Interval() | Box()
            | Region() | Motion() | Message() | List() | Entry() | Unsupported() | Unknown()
        ):  # fmt: skip
            return None


def no_element(owner: Type, index: int | str, span: Span, text: str, place: Span) -> Diagnostic:
    """The finding that a value has no elements, or no elements with names. `place` is the place of
    the index.
    """
    if isinstance(index, str) and isinstance(owner, Array) and isinstance(owner.names, tuple):
        return _unlisted(index, owner.names, place)
    if isinstance(index, str) and isinstance(owner, Array | Message):
        unnamed = ElementsWithoutNames(text=text)
        is_array = isinstance(owner, Array)
        return unnamed.at(span, help=unnamed.Place(text=text) if is_array else unnamed.Fields())
    finding = NotAnArray(purpose="an index", found=describe(owner))
    if isinstance(owner, Vector):
        return finding.at(span, help=finding.Components(text=text))
    if isinstance(owner, List):
        return finding.at(span, help=finding.AllElements(function="any", text=text))
    if isinstance(owner, Message) and owner.names is not None:
        return finding.at(span, help=finding.ByName(text=text))
    return finding.at(span, help=finding.NoIndex())


def _unlisted(index: str, names: tuple[str, ...], place: Span) -> Diagnostic:
    start = place.file.text.index(f'"{index}"', place.start)
    span = Span(place.file, start, start + len(index) + 2)
    finding = UnlistedName(identifier=index)
    near = near_name(index, names)
    if near is None:
        return finding.at(span, help=finding.Known(known=listed(names)))
    fix = Fix(f'write `"{near}"`', (Edit(span, f'"{near}"'),))
    return finding.at(span, help=DidYouMean(near=near), fix=fix)
