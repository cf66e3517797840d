"""The bounds of lists: the greatest number of messages in a list of an input."""

from __future__ import annotations

from dslkit.diagnostics import Collector, Edit, Fix
from dslkit.source import Span
from rossmarie.check.names.fields import lists_in
from rossmarie.check.system.errors import BoundWithoutList, ListBound
from rossmarie.syntax import ast
from rossmarie.types import List, Message, Type, Unknown

MOST_ELEMENTS = 65_536
MOST_POINTS = 1_048_576
"""The greatest bound of a cloud. No sensor sends as many points at once."""


def read_bound(declaration: ast.Input, type_: Type, field: str, collector: Collector) -> int | None:
    """The number after `up to`; None if there is none, or after reporting an error. `field` is the
    field that the input reads.
    """
    bound = declaration.bound
    if bound is None or isinstance(type_, Unknown):
        return None
    if not _has_lists(type_):
        finding = BoundWithoutList(field=field, bound=bound.span.text)
        collector.add(finding.at(bound.span, fix=_without(declaration, bound)))
        return None
    most = MOST_POINTS if _is_of_clouds(type_) else MOST_ELEMENTS
    if not bound.value.is_integer() or not 1 <= bound.value <= most:
        collector.add(ListBound(most=most, found=bound.span.text).at(bound.span))
        return None
    return int(bound.value)


def _has_lists(type_: Type) -> bool:
    return isinstance(type_, List) or (isinstance(type_, Message) and bool(lists_in(type_)))


def _is_of_clouds(type_: Type) -> bool:
    """Say whether all lists contain the points of clouds."""
    if isinstance(type_, List):
        return type_.is_of_points
    parts = type_.fields.values() if isinstance(type_, Message) else ()
    return all(_is_of_clouds(part) for part in parts if _has_lists(part))


def _without(declaration: ast.Input, bound: ast.Number) -> Fix | None:
    """The fix that removes `up to 64`; None if there are comments in between."""
    last = declaration.path[-1] if declaration.path else None
    before = last or declaration.message_type or declaration.topic
    file, start = bound.span.file, before.span.end
    if file.text[start : bound.span.start].split() != ["up", "to"]:
        return None
    edit = Edit(Span(file, start, bound.span.end), "")
    return Fix(f"leave `up to {bound.span.text}` out", (edit,))
