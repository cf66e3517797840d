"""Expressions of the core as terms of the solver, over real numbers."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import z3

from rossmarie.analysis.terms import constant
from rossmarie.core.expressions import (
    Applied,
    Chosen,
    Computed,
    Condition,
    ConstantNumber,
    Either,
    Expression,
    IsEqual,
    IsLess,
    IsUnknown,
    Local,
    Operand,
    Primitive,
)

Operation = Callable[[Primitive, Sequence[z3.ArithRef]], z3.ArithRef]


class Formulas:
    """Turns expressions with known operands into terms. `operate` performs the operations."""

    def __init__(self, operands: Sequence[z3.ArithRef], operate: Operation) -> None:
        self._operands = operands
        self._operate = operate

    def term(self, expression: Expression) -> z3.ArithRef:
        """A number. An unknown number can have any value."""
        match expression:
            case ConstantNumber(value=value):
                return constant(value) if value == value else z3.FreshReal("unknown")
            case Operand(index=index):
                return self._operands[index]
            case Local(value=value):
                return self.term(value)
            case Computed(primitive=primitive, operands=operands):
                return self._operate(primitive, [self.term(operand) for operand in operands])
            case Applied(function=function, operands=operands):
                terms = [self.term(operand) for operand in operands]
                return Formulas(terms, self._operate).term(function.expression)
            case Chosen(condition=condition, then=then, otherwise=otherwise):
                holds = self.condition(condition)
                if z3.is_false(holds):
                    return self.term(otherwise)
                return z3.If(holds, self.term(then), self.term(otherwise))

    def condition(self, condition: Condition) -> z3.BoolRef:
        """A condition on numbers that are known."""
        match condition:
            case IsLess(left=left, right=right):
                return self.term(left) < self.term(right)
            case IsEqual(left=left, right=right):
                return self.term(left) == self.term(right)
            case IsUnknown():
                return z3.BoolVal(False)
            case Either(left=one, right=other):
                return z3.simplify(z3.Or(self.condition(one), self.condition(other)))


def exactly(primitive: Primitive, values: Sequence[z3.ArithRef]) -> z3.ArithRef:
    """An operation in real numbers. Solvers have no roots, so a root is any number."""
    match primitive:
        case Primitive.ADD:
            return values[0] + values[1]
        case Primitive.SUBTRACT:
            return values[0] - values[1]
        case Primitive.MULTIPLY:
            return values[0] * values[1]
        case Primitive.DIVIDE:
            return values[0] / values[1]
        case Primitive.NEGATE:
            return -values[0]
        case Primitive.ABSOLUTE:
            return z3.If(values[0] >= 0, values[0], -values[0])
        case Primitive.SQUARE_ROOT:
            return z3.FreshReal("number")
