"""Numbers for fields of whole numbers."""

from __future__ import annotations

from rossmarie.check.actions.errors import IntegerMismatch
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import stripped
from rossmarie.ir.carried import Limits, is_carried
from rossmarie.syntax import ast
from rossmarie.units import DIMENSIONLESS, Unit


def is_whole(
    node: ast.Expression, si: float, field: str, held: tuple[Unit | None, Limits], context: Context
) -> bool:
    """Say whether a field of whole numbers can hold a number. The field has a unit and limits; the
    number is in SI. Report an error if the field cannot hold it.
    """
    unit, limits = held[0] or DIMENSIONLESS, held[1]
    number = unit.from_si(si) + 0.0
    if is_carried(limits, number):
        return True
    symbol = "" if unit == DIMENSIONLESS else f" {unit.symbol}"
    is_near = limits[0] <= number <= limits[1]
    problem = "is not a whole number" if is_near else "is out of its range"
    finding = IntegerMismatch(
        field=field,
        reason=f"{number:.15g}{symbol} {problem}",
        low=int(limits[0]),
        high=int(limits[1]),
        unit=symbol,
    )
    context.collector.add(finding.at(stripped(node).span))
    return False
