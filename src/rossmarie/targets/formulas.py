"""Expressions of the core as text. C and Python differ only in a few words."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rossmarie import ir
from rossmarie.core import AnyFunction, Function, Sampling, defined, parameters, row, sampling_row
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
    Subfunction,
    subfunctions_of,
)

_INFIX = {
    Primitive.ADD: ("+", 1),
    Primitive.SUBTRACT: ("-", 1),
    Primitive.MULTIPLY: ("*", 2),
    Primitive.DIVIDE: ("/", 2),
}
"""The operators between numbers, with their precedence."""


@dataclass(frozen=True)
class Notation:
    """The notation of one language, for everything in which languages differ.

    `calls` are the functions for operations. An operation is missing there if the language has an
    operator for it that follows IEEE 754. `chosen` selects one of two numbers by a condition.
    """

    number: Callable[[float], str]
    calls: Mapping[Primitive, str]
    chosen: str
    is_unknown: str
    either: str


class FormulaWriter:
    """Writes expressions in a dialect. The texts of the operands are atoms."""

    def __init__(self, dialect: Notation, operands: Sequence[str]) -> None:
        self._dialect = dialect
        self._operands = operands

    def text(self, expression: Expression) -> str:
        """An expression without parentheses around it."""
        return self._strong(expression, 0)

    def _strong(self, expression: Expression, least: int) -> str:
        """An expression, in parentheses unless its operator has at least this precedence."""
        match expression:
            case ConstantNumber(value=value):
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
            case Applied(function=function, operands=operands):
                return f"{function.name}({', '.join(map(self.text, operands))})"

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


@dataclass(frozen=True)
class FunctionDefinition:
    """A function of the core, for languages that define functions. `remark` describes it."""

    name: str
    parameters: tuple[str, ...]
    expression: Expression
    remark: str

    @property
    def is_inline(self) -> bool:
        """True if the definition is a single operation on its operands, or one of its operands, so
        that it needs no function.
        """
        operands = tuple(map(Operand, range(len(self.parameters))))
        match self.expression:
            case Operand():
                return True
            case Computed():
                return self.expression.operands == operands
            case ConstantNumber() | Chosen() | Local() | Applied():
                return False

    def call(self, dialect: Notation, operands: Sequence[str]) -> str:
        """The function applied to operands that are atoms of the language, before S4 applies."""
        if self.is_inline:
            return FormulaWriter(dialect, operands).text(self.expression)
        return f"{self.name}({', '.join(operands)})"


def definition_of(function: AnyFunction, count: int) -> FunctionDefinition:
    """A function of `count` numbers."""
    declared, names = row(function), parameters(count)
    number = "" if declared.most is not None else f"_{count}"
    remark = _sentence(declared.worded(names))
    return FunctionDefinition(
        f"{function.value}_of{number}", names, defined(function, count), remark
    )


def definition_of_subfunction(function: Subfunction) -> FunctionDefinition:
    """The definition of a subfunction, which other functions apply."""
    remark = _sentence(function.phrase.format(*function.parameters))
    return FunctionDefinition(function.name, function.parameters, function.expression, remark)


def definition_of_samples(function: Sampling) -> FunctionDefinition:
    """The definition of a function of samples. Its operands are views of the samples."""
    declared = sampling_row(function)
    remark = _sentence(declared.worded("a number", "a window" if declared.has_window else "a time"))
    names = tuple(view.value for view in declared.views)
    return FunctionDefinition(f"{function.value}_of", names, declared.expression, remark)


def definitions(
    machine: ir.Machine, is_called: Callable[[FunctionDefinition], bool]
) -> Iterator[FunctionDefinition]:
    """The functions of a machine that need a definition and are called, each once, and after the
    functions that it applies.
    """
    found = [definition_of(*each) for each in ir.functions(machine)]
    found += map(definition_of_samples, ir.samplings(machine))
    yield from _after_applied([each for each in found if is_called(each)])


def fixed_definitions() -> Iterator[FunctionDefinition]:
    """All functions that take a fixed number of operands, in the same order. They are the same for
    all machines.
    """
    found = [
        definition_of(each, row(each).least) for each in Function if row(each).most is not None
    ]
    yield from _after_applied([*found, *map(definition_of_samples, Sampling)])


def _after_applied(found: Sequence[FunctionDefinition]) -> Iterator[FunctionDefinition]:
    """The definitions that are needed, each after the definitions that it applies."""
    called = [each for each in found if not each.is_inline]
    applied = dict.fromkeys(part for each in called for part in subfunctions_of(each.expression))
    yield from map(definition_of_subfunction, applied)
    yield from called


def _sentence(words: str) -> str:
    return f"{words[0].upper()}{words[1:]}."
