"""Expressions of the core as text: C and Python write them alike but for a few words."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from rossmarie.core import Function, defined
from rossmarie.core.expressions import (
    Chosen,
    Computed,
    Condition,
    Either,
    Expression,
    IsEqual,
    IsLess,
    IsUnknown,
    Local,
    Number,
    Operand,
    Primitive,
)

_INFIX = {
    Primitive.ADD: ("+", 1),
    Primitive.SUBTRACT: ("-", 1),
    Primitive.MULTIPLY: ("*", 2),
    Primitive.DIVIDE: ("/", 2),
}
"""The operators between numbers, with how strong they bind."""


@dataclass(frozen=True)
class Dialect:
    """How a language writes what languages write differently.

    `calls` are the functions for operations; those between numbers have none where the language has
    an operator that does as IEEE 754 says. `chosen` is a choice of a condition and two numbers.
    """

    number: Callable[[float], str]
    calls: Mapping[Primitive, str]
    chosen: str
    is_unknown: str
    either: str


class Formulas:
    """Writes expressions in a dialect, with these texts, which are atoms, for their operands."""

    def __init__(self, dialect: Dialect, operands: Sequence[str]) -> None:
        self._dialect = dialect
        self._operands = operands

    def text(self, expression: Expression) -> str:
        """An expression that stands alone."""
        return self._strong(expression, 0)

    def _strong(self, expression: Expression, least: int) -> str:
        """An expression, in parentheses unless it binds as strong as this."""
        match expression:
            case Number(value=value):
                return self._dialect.number(value)
            case Operand(index=index):
                return self._operands[index]
            case Local(name=name):
                return name
            case Chosen(condition=condition, then=then, otherwise=otherwise):
                parts = (self._condition(condition), self._strong(then, 1), self.text(otherwise))
                text = self._dialect.chosen.format(*parts)
                return f"({text})" if least else text
            case Computed(primitive=primitive, operands=operands):
                return self._computed(primitive, operands, least)

    def _computed(self, primitive: Primitive, operands: tuple[Expression, ...], least: int) -> str:
        if primitive in self._dialect.calls:
            return f"{self._dialect.calls[primitive]}({', '.join(map(self.text, operands))})"
        if primitive is Primitive.NEGATE:
            return f"-({self.text(operands[0])})"
        sign, own = _INFIX[primitive]
        text = f"{self._strong(operands[0], own)} {sign} {self._strong(operands[1], own + 1)}"
        return f"({text})" if own < least else text

    def _condition(self, condition: Condition) -> str:
        match condition:
            case IsLess(left=left, right=right):
                return f"{self._strong(left, 1)} < {self._strong(right, 1)}"
            case IsEqual(left=left, right=right):
                return f"{self._strong(left, 1)} == {self._strong(right, 1)}"
            case IsUnknown(operand=operand):
                return self._dialect.is_unknown.format(self._strong(operand, 1))
            case Either(left=one, right=other):
                return self._dialect.either.format(self._condition(one), self._condition(other))


def is_plain(function: Function, count: int) -> bool:
    """Whether a function is one operation on its operands, for which no language needs a function
    of its own.
    """
    expression = defined(function, count)
    if not isinstance(expression, Computed):
        return False
    return expression.operands == tuple(map(Operand, range(count)))
