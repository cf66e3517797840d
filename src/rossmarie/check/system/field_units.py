"""One unit for one field of one topic, however many inputs read it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from dslkit.diagnostics import Collector, Diagnostic
from dslkit.source import Span
from rossmarie.check.model import CheckedInput
from rossmarie.check.names.fields import unit_of
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import path_of, root_of
from rossmarie.check.system.errors import FieldUnitConflict, Here
from rossmarie.check.units.quantities import end_of_field, is_same_unit
from rossmarie.syntax import ast
from rossmarie.syntax.walk import walk
from rossmarie.types import Message, Type, Vector
from rossmarie.units import Unit

FieldKey = tuple[str, tuple[str, ...]]


def check_one_unit(
    found: CheckedInput, stated: dict[FieldKey, CheckedInput], collector: Collector
) -> None:
    """Report an error if an earlier input reads the same field in another unit.

    `stated` contains the earlier inputs, by topic and path; `found` is added to it.
    """
    unit = unit_of(found.type)
    if unit is None:
        return
    earlier = [
        stated.setdefault((found.topic, path), found)
        for path in _with_components(found.path, found.type)
    ]
    for first in earlier:
        expected = unit_of(first.type)
        if expected is not None and not is_same_unit(unit, expected):
            collector.add(_conflict(found, unit, first, expected))
            return


def check_read_units(stated: Mapping[FieldKey, CheckedInput], context: Context) -> None:
    """Report fields of whole messages that another input of the same topic reads in another unit.
    `stated` contains those inputs, by topic and path.
    """
    reported: set[tuple[str, str]] = set()
    for expression in context.declarations.expressions():
        for part in walk(expression):
            if isinstance(part, ast.Member):
                _check_read(part, stated, reported, context)


def _check_read(
    node: ast.Member,
    stated: Mapping[FieldKey, CheckedInput],
    reported: set[tuple[str, str]],
    context: Context,
) -> None:
    root = root_of(node)
    whole = None if root is None else context.inputs.get(root.name.text)
    type_ = context.type_of(node)
    unit = unit_of(type_)
    if whole is None or unit is None or not isinstance(whole.type, Message):
        return
    path = (*whole.path, *path_of(node))
    for place in _with_components(path, type_):
        first = stated.get((whole.topic, place))
        expected = None if first is None else unit_of(first.type)
        if first is None or expected is None or is_same_unit(unit, expected):
            continue
        names = (whole.declaration.name.text, first.declaration.name.text)
        if names not in reported:
            reported.add(names)
            field = ".".join((whole.message_type, *path))
            finding = FieldUnitConflict(
                topic=whole.topic, field=field, found=unit.symbol, expected=expected.symbol
            )
            label = Here(what=expected.symbol).at(_place(first))
            context.collector.add(finding.at(node.span, label))
        return


def _conflict(found: CheckedInput, unit: Unit, first: CheckedInput, expected: Unit) -> Diagnostic:
    finding = FieldUnitConflict(
        topic=found.topic,
        field=".".join((found.message_type, *found.path)),
        found=unit.symbol,
        expected=expected.symbol,
    )
    return finding.at(_place(found), Here(what=expected.symbol).at(_place(first)))


def _with_components(path: tuple[str, ...], type_: Type) -> Iterator[tuple[str, ...]]:
    """The path of the field. For a vector, the paths of its components as well."""
    yield path
    if isinstance(type_, Vector):
        yield from ((*path, axis) for axis in "xyz")


def _place(found: CheckedInput) -> Span:
    """The place of the unit as written, or else of the topic and the field; then the unit comes
    from the table of units.
    """
    declaration = found.declaration
    if declaration.unit is not None:
        return declaration.unit.span
    return declaration.topic.span.to(end_of_field(declaration))
