"""One field of one topic arrives in one unit, however many inputs read it."""

from __future__ import annotations

from collections.abc import Iterator

from dslkit.diagnostics import Collector, Diagnostic, Label
from dslkit.source import Span
from rossmarie.check.fields import unit_of
from rossmarie.check.model import CheckedInput
from rossmarie.check.unit_errors import FieldUnitConflict
from rossmarie.check.units import end_of_field
from rossmarie.types import Vector
from rossmarie.units import Unit

FieldKey = tuple[str, tuple[str, ...]]


def check_one_unit(
    found: CheckedInput, stated: dict[FieldKey, CheckedInput], collector: Collector
) -> None:
    """Report if an earlier input reads the same field in another unit.

    `stated` are the earlier ones, by topic and path; `found` is added to it.
    """
    unit = unit_of(found.type)
    if unit is None:
        return
    earlier = [stated.setdefault((found.topic, path), found) for path in _paths(found)]
    for first in earlier:
        expected = unit_of(first.type)
        if expected is not None and not is_same_unit(unit, expected):
            collector.add(_conflict(found, unit, first, expected))
            return


def _conflict(found: CheckedInput, unit: Unit, first: CheckedInput, expected: Unit) -> Diagnostic:
    finding = FieldUnitConflict(
        topic=found.topic,
        field=".".join((found.message_type, *found.path)),
        found=unit.symbol,
        expected=expected.symbol,
    )
    return finding.at(_place(found), Label(_place(first), f"{expected.symbol} here"))


def _paths(found: CheckedInput) -> Iterator[tuple[str, ...]]:
    """The path of the field; of a vector, those of its components as well."""
    yield found.path
    if isinstance(found.type, Vector):
        yield from ((*found.path, axis) for axis in "xyz")


def is_same_unit(unit: Unit, other: Unit) -> bool:
    """Whether two units are one by different names, as `s` and `sec`."""
    return (unit.dimension, unit.scale, unit.offset) == (
        other.dimension,
        other.scale,
        other.offset,
    )


def _place(found: CheckedInput) -> Span:
    """The unit as written, else the topic and the field, whose unit the table knows."""
    declaration = found.declaration
    if declaration.unit is not None:
        return declaration.unit.span
    return declaration.topic.span.to(end_of_field(declaration))
