"""Parameters that the running node may set. Rules read them as numbers, and they can only tighten a
rule.
"""

from __future__ import annotations

from rossmarie.check.expressions.infer import infer
from rossmarie.check.expressions.parameters import fits_parameter
from rossmarie.check.instances.errors import ParameterMismatch
from rossmarie.check.model import CheckedInput
from rossmarie.check.operations.operands import require_constant
from rossmarie.check.scopes.context import Context
from rossmarie.check.wording.describe import describe
from rossmarie.ir.settings import MESSAGE, PREFIX
from rossmarie.syntax import ast
from rossmarie.types import Quantity, Type, Unknown
from rossmarie.units import si_unit


def resolve_node_parameters(context: Context) -> None:
    """Resolve the parameters into `context.inputs`. The values of constants are already known."""
    for declaration in context.declarations.inputs:
        if declaration.setting is not None:
            type_ = _type_of(declaration.setting, context)
            name = declaration.name.text
            found = CheckedInput(declaration, PREFIX + name, MESSAGE, ("data",), type_, None)
            context.inputs.setdefault(name, found)


def _type_of(setting: ast.Constant, context: Context) -> Type:
    """The type of a parameter: a number in SI, as the node takes it; `Unknown` after reporting an
    error.
    """
    context.enter(None)
    found = infer(setting.value, context)
    if isinstance(found, Unknown):
        return found
    if not require_constant(setting.value, "the value of a parameter", context):
        return Unknown()
    if not fits_parameter(setting, found, context):
        return Unknown()
    if not isinstance(found, Quantity):
        expected = "a number"
        name, its = setting.name.text, setting.value.span
        finding = ParameterMismatch(identifier=name, expected=expected, found=describe(found))
        place = finding.Declared(expected=f"{expected} that may be tightened").at(setting.name.span)
        context.collector.add(finding.at(its, place))
        return Unknown()
    return Quantity(None if found.unit is None else si_unit(found.unit.dimension))
