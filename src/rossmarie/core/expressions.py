"""Expressions of the core: numbers and conditions on them, as IEEE 754 defines them.

Every function of numbers is such an expression (`functions.py`). Code that computes, writes or
encodes functions needs to know nothing else. Operands are `Operand(0)`, `Operand(1)` ... in the
order of the parameters. A comparison with NaN is false, as in C.

Python's operators create expressions, so that a definition reads like its formula.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Iterator
from dataclasses import dataclass


class Primitive(enum.Enum):
    """The basic operations. Each rounds once, to nearest even."""

    ADD = "add"
    SUBTRACT = "subtract"
    MULTIPLY = "multiply"
    DIVIDE = "divide"
    NEGATE = "negate"
    ABSOLUTE = "absolute"
    SQUARE_ROOT = "square_root"


class _Formula:
    """The operators that create expressions."""

    def __add__(self, other: Written) -> Computed:
        return Computed(Primitive.ADD, (self._own(), written(other)))

    def __sub__(self, other: Written) -> Computed:
        return Computed(Primitive.SUBTRACT, (self._own(), written(other)))

    def __rsub__(self, other: Written) -> Computed:
        return Computed(Primitive.SUBTRACT, (written(other), self._own()))

    def __mul__(self, other: Written) -> Computed:
        return Computed(Primitive.MULTIPLY, (self._own(), written(other)))

    def __rmul__(self, other: Written) -> Computed:
        return Computed(Primitive.MULTIPLY, (written(other), self._own()))

    def __truediv__(self, other: Written) -> Computed:
        return Computed(Primitive.DIVIDE, (self._own(), written(other)))

    def __neg__(self) -> Computed:
        return Computed(Primitive.NEGATE, (self._own(),))

    def __abs__(self) -> Computed:
        return Computed(Primitive.ABSOLUTE, (self._own(),))

    def __lt__(self, other: Written) -> IsLess:
        return IsLess(self._own(), written(other))

    def __gt__(self, other: Written) -> IsLess:
        return IsLess(written(other), self._own())

    def equals(self, other: Written) -> IsEqual:
        """The condition that two numbers are equal."""
        return IsEqual(self._own(), written(other))

    def _own(self) -> Expression:
        assert isinstance(self, ConstantNumber | Operand | Computed | Chosen | Local | Applied)
        return self


@dataclass(frozen=True)
class ConstantNumber(_Formula):
    """A number that is known at compile time."""

    value: float


@dataclass(frozen=True)
class Operand(_Formula):
    """An operand of the function."""

    index: int


@dataclass(frozen=True)
class Computed(_Formula):
    """An operation on numbers."""

    primitive: Primitive
    operands: tuple[Expression, ...]


@dataclass(frozen=True)
class Chosen(_Formula):
    """One number if a condition is true, else another."""

    condition: Condition
    then: Expression
    otherwise: Expression


@dataclass(frozen=True, eq=False)
class Local(_Formula):
    """A named number, which is computed once, however often it occurs in a function. Two objects
    with the same name are two numbers.
    """

    name: str
    value: Expression


@dataclass(frozen=True, eq=False)
class Subfunction:
    """A function inside other functions: its expression is written once, under its name.

    `phrase` words it for readers, with `{0}` and `{1}` for operands.
    """

    name: str
    parameters: tuple[str, ...]
    expression: Expression
    phrase: str

    def __call__(self, *operands: Expression) -> Applied:
        """The function applied to some numbers."""
        return Applied(self, operands)


@dataclass(frozen=True)
class Applied(_Formula):
    """A subfunction applied to some numbers."""

    function: Subfunction
    operands: tuple[Expression, ...]


Expression = ConstantNumber | Operand | Computed | Chosen | Local | Applied
Written = _Formula | float


@dataclass(frozen=True)
class IsLess:
    """The condition that the first number is less than the second; false if either is NaN."""

    left: Expression
    right: Expression


@dataclass(frozen=True)
class IsEqual:
    """The condition that both numbers are equal; false if either is NaN."""

    left: Expression
    right: Expression


@dataclass(frozen=True)
class IsUnknown:
    """The condition that a number is NaN."""

    operand: Expression


@dataclass(frozen=True)
class Either:
    """At least one of two conditions holds."""

    left: Condition
    right: Condition


Condition = IsLess | IsEqual | IsUnknown | Either

UNKNOWN = ConstantNumber(math.nan)


def written(value: Written) -> Expression:
    """An expression, or a number as an expression."""
    return value._own() if isinstance(value, _Formula) else ConstantNumber(value)  # noqa: SLF001


def choose(condition: Condition, then: Written, otherwise: Written) -> Chosen:
    """`then` if the condition is true, else `otherwise`."""
    return Chosen(condition, written(then), written(otherwise))


def square_root(x: Expression) -> Computed:
    """The square root, rounded correctly; NaN below zero."""
    return Computed(Primitive.SQUARE_ROOT, (x,))


def operands_of(expression: Expression) -> Iterator[int]:
    """The operands in an expression, from left to right, including repetitions."""
    match expression:
        case ConstantNumber():
            pass
        case Operand(index=index):
            yield index
        case Computed(operands=operands) | Applied(operands=operands):
            for operand in operands:
                yield from operands_of(operand)
        case Chosen(condition=condition, then=then, otherwise=otherwise):
            for part in (*compared_in(condition), then, otherwise):
                yield from operands_of(part)
        case Local(value=value):
            yield from operands_of(value)


def compared_in(condition: Condition) -> Iterator[Expression]:
    """The numbers in a condition."""
    match condition:
        case IsLess(left=left, right=right) | IsEqual(left=left, right=right):
            yield from (left, right)
        case IsUnknown(operand=operand):
            yield operand
        case Either(left=one, right=other):
            yield from compared_in(one)
            yield from compared_in(other)


def locals_of(expression: Expression) -> tuple[Local, ...]:
    """The named numbers in an expression, each once, after the named numbers that it uses."""
    return tuple(each for each in _named_in(expression) if isinstance(each, Local))


def applied_in(expression: Expression) -> tuple[Subfunction, ...]:
    """The subfunctions that an expression applies, each once."""
    return tuple(each for each in _named_in(expression) if isinstance(each, Subfunction))


def subfunctions_of(expression: Expression) -> tuple[Subfunction, ...]:
    """The subfunctions of an expression and of its subfunctions, each once, after the subfunctions
    that it applies.
    """
    found: dict[Subfunction, None] = {}
    for each in applied_in(expression):
        found.update(dict.fromkeys((*subfunctions_of(each.expression), each)))
    return tuple(found)


def _named_in(expression: Expression) -> dict[Local | Subfunction, None]:
    found: dict[Local | Subfunction, None] = {}
    _collect(expression, found)
    return found


def _collect(expression: Expression, found: dict[Local | Subfunction, None]) -> None:
    match expression:
        case ConstantNumber() | Operand():
            pass
        case Computed(operands=operands):
            for operand in operands:
                _collect(operand, found)
        case Applied(function=function, operands=operands):
            for operand in operands:
                _collect(operand, found)
            found.setdefault(function)
        case Chosen(condition=condition, then=then, otherwise=otherwise):
            for part in (*compared_in(condition), then, otherwise):
                _collect(part, found)
        case Local(value=value):
            if expression not in found:
                _collect(value, found)
                found.setdefault(expression)
