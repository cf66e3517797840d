"""Fields of messages: their names and types."""

from __future__ import annotations

from dataclasses import replace

from dslkit.diagnostics import Collector, DidYouMean, Edit, Fix, Remark, listed
from dslkit.source import Span
from rossmarie.check.names.errors import FieldNotUsable, UnknownField
from rossmarie.check.wording.gaps import without
from rossmarie.check.wording.suggestions import near_name, rename
from rossmarie.syntax import ast
from rossmarie.types import (
    Array,
    Boolean,
    Entry,
    List,
    Message,
    Point,
    Quantity,
    Quaternion,
    ScanPoint,
    Type,
    Unknown,
    Unsupported,
    Vector,
)
from rossmarie.units import DIMENSIONLESS, Unit

_ANGLES = ("roll", "pitch", "yaw")


def members(type_: Type) -> dict[str, Type]:
    """The names that can follow a dot, except functions."""
    if isinstance(type_, Message):
        return dict(type_.fields)
    if isinstance(type_, Entry):
        parts = {name: _entry_of(part) for name, part in type_.message.fields.items()}
        return {name: part for name, part in parts.items() if part is not None}
    if isinstance(type_, Vector):
        others = type_.fields if isinstance(type_, ScanPoint) else {}
        return {**dict.fromkeys("xyz", type_.element), **others}
    if isinstance(type_, Quaternion):
        return dict.fromkeys("xyzw", Quantity(DIMENSIONLESS))
    return {}


def lists_in(message: Message) -> list[tuple[str, ...]]:
    """The paths to the lists of messages that a message has."""
    found: list[tuple[str, ...]] = []
    waiting: list[tuple[tuple[str, ...], Type]] = [((), message)]
    while waiting:
        path, type_ = waiting.pop()
        if isinstance(type_, List):
            found.append(path)
        elif isinstance(type_, Message):
            inside = [((*path, name), part) for name, part in type_.fields.items()]
            waiting.extend(reversed(inside))
    return found


def _entry_of(part: Type) -> Type | None:
    """The type of a part of a message under one name: elements of arrays, including nested ones."""
    if isinstance(part, Array):
        return part.element
    return Entry(part) if isinstance(part, Message) and members(Entry(part)) else None


def select(
    owner: Type, name: ast.Name, owner_text: str, before: Span, collector: Collector
) -> Type:
    """The type of a member of `owner`; `Unknown` after reporting that there is no such member.
    `owner_text` names the owner in messages, and `before` is the text before the dot.
    """
    if isinstance(owner, Unknown):
        return owner
    if isinstance(owner, Point):
        return owner.member(name.text)
    found = members(owner).get(name.text)
    if found is None:
        _report_unknown(owner, name, owner_text, before, collector)
        return Unknown()
    if isinstance(found, Unsupported):
        collector.add(FieldNotUsable(identifier=name.text, reason=found.reason).at(name.span))
        return Unknown()
    return found


def with_unit(type_: Type, unit: Unit) -> Type | None:
    """The same numbers in another unit; None if there are no numbers that could have a unit."""
    if isinstance(type_, Quantity):
        return replace(type_, unit=unit)
    if isinstance(type_, Vector):
        return replace(type_, element=Quantity(unit))
    if isinstance(type_, Array) and isinstance(type_.element, Quantity):
        return replace(type_, element=replace(type_.element, unit=unit))
    return None


def unit_of(type_: Type) -> Unit | None:
    """The unit of a number, a vector or an array of numbers."""
    if isinstance(type_, Quantity):
        return type_.unit
    if isinstance(type_, Vector):
        return type_.element.unit
    if isinstance(type_, Array) and isinstance(type_.element, Quantity):
        return type_.element.unit
    return None


def has_no_number(type_: Type) -> bool:
    """Say whether `with_unit` has no numbers to change."""
    return not isinstance(type_, Quantity | Vector) and not (
        isinstance(type_, Array) and not isinstance(type_.element, Boolean)
    )


def _report_unknown(
    owner: Type, name: ast.Name, owner_text: str, before: Span, collector: Collector
) -> None:
    known = tuple(members(owner))
    shown = owner.name if isinstance(owner, Message) else f"`{owner_text}`"
    finding = UnknownField(identifier=name.text, owner=shown)
    near = near_name(name.text, known)
    help: Remark
    if near is not None:
        help, fix = DidYouMean(near=near), rename(name, near)
    elif isinstance(owner, Quaternion) and name.text in _ANGLES:
        behind = Span(name.span.file, name.span.end, name.span.end)
        help = finding.Function(owner=owner_text, name=name.text)
        fix = Fix(f"write `{name.text}()`", (Edit(behind, "()"),))
    elif isinstance(owner, List):
        help, fix = finding.InList(name=name.text), None
    elif known:
        help, fix = finding.Known(known=listed(known)), None
    elif name.text == "data":
        help = finding.AlreadyData(owner=owner_text)
        fix = Fix("leave `.data` out", without(before, ".", name.span))
    else:
        help, fix = finding.NoFields(), None
    collector.add(finding.at(name.span, help=help, fix=fix))
