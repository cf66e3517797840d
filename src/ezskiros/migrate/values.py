"""The type of a default or a compared value, as far as its source text shows it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import libcst as cst

from ezskiros.migrate.calls import last_name

BASIC = ("str", "int", "float", "bool")
_ENUMERATIONS = {"Enum", "IntEnum", "StrEnum", "Flag", "IntFlag"}
_FLOATS_OF_MATH = {"pi", "e", "tau", "inf", "radians", "degrees", "sqrt", "sin", "cos", "tan"}
_NUMBERS = ("bool", "int", "float")
_NOT_ARITHMETIC = (cst.BitOr, cst.BitAnd, cst.BitXor, cst.LeftShift, cst.RightShift, cst.Power)


@dataclass
class KnownValues:
    """The names of a module whose values are known: constants that are set once, and
    enumerations.
    """

    constants: Mapping[str, cst.BaseExpression] = field(default_factory=dict)
    enumerations: frozenset[str] = frozenset()

    def type_of(self, value: cst.BaseExpression) -> str | None:
        """The name of the type; None if it is unknown or not a type of parameters."""
        match value:
            case cst.SimpleString() | cst.ConcatenatedString() | cst.FormattedString():
                is_bytes = isinstance(getattr(value, "evaluated_value", ""), bytes)
                return None if is_bytes else "str"
            case cst.Integer():
                return "int"
            case cst.Float():
                return "float"
            case cst.Name(value="True" | "False") | cst.Comparison():
                return "bool"
            case cst.UnaryOperation(operator=cst.Not()):
                return "bool"
            case cst.UnaryOperation(operator=cst.Minus() | cst.Plus(), expression=inner):
                found = self.type_of(inner)
                return "int" if found == "bool" else found if found in _NUMBERS else None
            case cst.BinaryOperation():
                return self._arithmetic(value)
            case cst.Call(func=cst.Name(value=name)) if name in BASIC:
                return name
            case cst.Attribute(value=cst.Name(value=name)) if name in self.enumerations:
                return name
            case cst.Name(value=name) if name in self.constants:
                others = {key: each for key, each in self.constants.items() if key != name}
                return KnownValues(others, self.enumerations).type_of(self.constants[name])
            case _:  # open: any other node
                pass
        return self._of_math(value)

    def _arithmetic(self, value: cst.BinaryOperation) -> str | None:
        left, right = self.type_of(value.left), self.type_of(value.right)
        if left == right == "str" and isinstance(value.operator, cst.Add):
            return "str"
        is_number = left in _NUMBERS and right in _NUMBERS
        if not is_number or isinstance(value.operator, _NOT_ARITHMETIC):
            return None
        return "float" if "float" in (left, right) or _divides(value) else "int"

    def _of_math(self, value: cst.BaseExpression) -> str | None:
        """The type of `math.pi` and of calls such as `math.radians(90)`."""
        found = value.func if isinstance(value, cst.Call) else value
        is_math = isinstance(found, cst.Attribute) and last_name(found.value) == "math"
        return "float" if is_math and last_name(found) in _FLOATS_OF_MATH else None


def _divides(value: cst.BinaryOperation) -> bool:
    return isinstance(value.operator, cst.Divide)


def known_of(module: cst.Module) -> KnownValues:
    """Collect the names that the top level of a module sets to known values."""
    constants: dict[str, cst.BaseExpression | None] = {}
    enumerations = set()
    for statement in module.body:
        if isinstance(statement, cst.ClassDef):
            bases = {last_name(each.value) for each in statement.bases}
            enumerations |= {statement.name.value} if bases & _ENUMERATIONS else set()
        for name, value in _assigned(statement):
            constants[name] = None if name in constants else value
    single = {name: value for name, value in constants.items() if value is not None}
    return KnownValues(single, frozenset(enumerations))


def _assigned(statement: cst.CSTNode) -> Sequence[tuple[str, cst.BaseExpression]]:
    """The assignment in a line such as `NAME = value`. Other changes of names are in other
    statements.
    """
    lines = statement.body if isinstance(statement, cst.SimpleStatementLine) else ()
    return [
        (target.target.value, each.value)
        for each in lines
        if isinstance(each, cst.Assign)
        for target in each.targets
        if isinstance(target.target, cst.Name)
    ]
