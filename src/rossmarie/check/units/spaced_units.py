"""`10 km / h`: a unit with spaces, so that its second part looks like an undeclared name."""

from __future__ import annotations

from typing import NamedTuple

from dslkit.diagnostics import Edit, Fix
from rossmarie.check.scopes.context import Context
from rossmarie.check.units.errors import SpacedUnit
from rossmarie.check.units.quantities import SECOND
from rossmarie.syntax import ast
from rossmarie.syntax.ast import BinaryOperator
from rossmarie.units import UnknownUnitError, parse_unit

_LINKS = frozenset({BinaryOperator.MULTIPLY, BinaryOperator.DIVIDE})


class _Step(NamedTuple):
    """`/ h` after a number or after another step."""

    whole: ast.Binary
    name: ast.Name


def is_rest_of_unit(node: ast.Reference, context: Context) -> bool:
    """Say whether an undeclared name is meant as part of the unit before it.

    A unit in several parts, `1 kg * m / s`, is reported once, at its last part.
    """
    first = _step(context.parents.get(node), context)
    if first is None or first.whole.right is not node:
        return False
    steps = _steps_around(first, context)
    number = steps[0].whole.left
    if not isinstance(number, ast.Number):
        return False
    if steps[-1].whole.right is node:
        _report(number, steps, context)
    return True


def _steps_around(step: _Step, context: Context) -> list[_Step]:
    """All steps of the chain of `step`, in source order."""
    before: _Step | None = step
    steps: list[_Step] = []
    while before is not None:
        steps.insert(0, before)
        before = _step(before.whole.left, context)
    while True:
        behind = _step(context.parents.get(steps[-1].whole), context)
        if behind is None or behind.whole.left is not steps[-1].whole:
            return steps
        steps.append(behind)


def _step(node: ast.Expression | None, context: Context) -> _Step | None:
    """The node as a step: a product or quotient with an undeclared name that is a unit."""
    if not isinstance(node, ast.Binary) or node.operator not in _LINKS:
        return None
    if not isinstance(node.right, ast.Reference):
        return None
    name = node.right.name
    own = context.declarations.conditions.get(context.entity or "", {})
    is_declared = name.text in context.declarations.names or name.text in own
    return None if is_declared or not _is_unit(name.text) else _Step(node, name)


def _report(number: ast.Number, steps: list[_Step], context: Context) -> None:
    last = steps[-1]
    corrected = _corrected(number, steps)
    finding = SpacedUnit(
        identifier=last.name.text,
        operator=last.whole.operator.value,
        corrected=corrected or "10 km/h",
    )
    help, fix = None, None
    if corrected is None:
        help = finding.OnePiece()
    else:
        fix = Fix(f"write `{corrected}`", (Edit(last.whole.span, corrected),))
    context.collector.add(finding.at(last.whole.span, help=help, fix=fix))


def _corrected(number: ast.Number, steps: list[_Step]) -> str | None:
    """The number with its unit in one piece; None if there is no such unit."""
    first, *rest = steps
    if number.unit is None and first.whole.operator is BinaryOperator.DIVIDE:
        return None if rest else _reciprocal(number, first.name.text)
    digits = number.span.text
    if number.unit is not None:
        digits = number.span.file.text[number.span.start : number.unit.span.start].rstrip()
        rest = steps
        unit = number.unit.text
    else:
        unit = first.name.text
    unit += "".join(f"{step.whole.operator.value}{step.name.text}" for step in rest)
    return f"{digits} {unit}" if _is_unit(unit) else None


def _reciprocal(number: ast.Number, unit: str) -> str:
    """`10 Hz` for `10 / s`; a unit cannot begin with `1/`."""
    digits = number.span.text
    return f"{digits} Hz" if parse_unit(unit) == SECOND else f"{digits} / 1 {unit}"


def _is_unit(text: str) -> bool:
    try:
        parse_unit(text)
    except UnknownUnitError:
        return False
    return True
