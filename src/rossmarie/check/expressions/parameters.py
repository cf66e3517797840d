"""The values that imports give to parameters. Their types and dimensions must be the declared
ones.
"""

from __future__ import annotations

from rossmarie.check.expressions.infer import infer
from rossmarie.check.instances.errors import ParameterMismatch
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import constant_of
from rossmarie.check.units.quantities import read_unit
from rossmarie.check.wording.describe import describe
from rossmarie.syntax import ast
from rossmarie.syntax.walk import walk
from rossmarie.types import Box, Interval, Quantity, Type, Unknown, unit_faults


def fits_parameter(constant: ast.Constant, found: Type, context: Context) -> bool:
    """Say whether the value of a constant has the type that its parameter requires. Report an error
    if it does not.
    """
    parameter = constant.parameter
    if parameter is None:
        return True
    declared = _declared(parameter, context)
    if declared is None or _is_alike(declared, found):
        return True
    expected = describe(declared)
    finding = ParameterMismatch(
        identifier=constant.name.text, expected=expected, found=describe(found)
    )
    place = finding.Declared(expected=expected).at(parameter.name.span)
    context.collector.add(finding.at(constant.value.span, place))
    return False


def values_of(constant: ast.Constant) -> tuple[ast.Expression, ...]:
    """The value of a constant, and the default of the parameter that the constant stands for."""
    default = None if constant.parameter is None else constant.parameter.default
    if default is None or isinstance(default, ast.Name):
        return (constant.value,)
    return (constant.value, default)


def rests_on_parameter(node: ast.Expression, context: Context) -> bool:
    """Say whether an expression depends on a parameter."""
    constants = (constant_of(part, context.declarations) for part in walk(node))
    return any(each is not None and each.parameter is not None for each in constants)


def _declared(parameter: ast.Parameter, context: Context) -> Type | None:
    """The type of the default, or a number in the unit; None if unknown."""
    if parameter.unit is not None:
        unit = read_unit(parameter.unit, context.collector)
        return None if unit is None else Quantity(unit)
    assert not isinstance(parameter.default, ast.Name)
    found = None if parameter.default is None else infer(parameter.default, context)
    return None if isinstance(found, Unknown) else found


def _is_alike(declared: Type, found: Type) -> bool:
    if isinstance(found, Unknown):
        return True
    if isinstance(declared, Quantity) and isinstance(found, Quantity):
        return not unit_faults(declared, found)
    if isinstance(declared, Interval | Box) and isinstance(found, Interval | Box):
        is_same = type(declared) is type(found)
        return is_same and not unit_faults(declared.element, found.element)
    return type(declared) is type(found)
