"""Numbers and propositions as terms of the solver: Kleene's logic (S1, S2) and exact constants."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import z3

from rossmarie.ir import (
    And,
    Between,
    Compare,
    Comparison,
    Flag,
    Literal,
    Not,
    Or,
    TruthValue,
)

YES = z3.BoolVal(True)
NO = z3.BoolVal(False)


@dataclass(frozen=True)
class NumberTerm:
    """A signal: a flag that it is known, and its value in SI if it is known."""

    known: z3.BoolRef
    value: z3.ArithRef


@dataclass(frozen=True)
class PropositionTerm:
    """A proposition as three flags, T, F and S. At most one flag is true. If no flag is true, the
    value is U.
    """

    true: z3.BoolRef
    false: z3.BoolRef
    stale: z3.BoolRef

    def is_value(self, value: TruthValue) -> z3.BoolRef:
        """Say whether a proposition has this value."""
        match value:
            case TruthValue.TRUE:
                return self.true
            case TruthValue.FALSE:
                return self.false
            case TruthValue.STALE:
                return self.stale
            case TruthValue.UNKNOWN:
                return z3.Not(z3.Or(self.true, self.false, self.stale))

    @property
    def activates(self) -> z3.BoolRef:
        """Say whether a rule with this condition becomes active (S35)."""
        return z3.Or(self.true, self.stale)


def literal(value: bool) -> PropositionTerm:
    """T or F."""
    return PropositionTerm(YES if value else NO, NO if value else YES, NO)


FALSE = literal(False)


def free_fact(name: str, facts: list[z3.BoolRef]) -> PropositionTerm:
    """A proposition of any value. Facts about it are added to `facts`."""
    true, false, stale = (z3.Bool(f"{name}.{value}") for value in "TFS")
    facts.append(z3.AtMost(true, false, stale, 1))
    return PropositionTerm(true, false, stale)


def choice(condition: z3.BoolRef, one: PropositionTerm, other: PropositionTerm) -> PropositionTerm:
    """The first proposition if the condition is true, else the other proposition."""
    return PropositionTerm(
        z3.If(condition, one.true, other.true),
        z3.If(condition, one.false, other.false),
        z3.If(condition, one.stale, other.stale),
    )


def negation(operand: PropositionTerm) -> PropositionTerm:
    """The negation, `not` (S2)."""
    return PropositionTerm(operand.false, operand.true, operand.stale)


def conjunction(operands: Sequence[PropositionTerm]) -> PropositionTerm:
    """The conjunction, `and` (S2)."""
    false = z3.Or([operand.false for operand in operands])
    stale = z3.And(z3.Not(false), z3.Or([operand.stale for operand in operands]))
    return PropositionTerm(z3.And([operand.true for operand in operands]), false, stale)


def disjunction(operands: Sequence[PropositionTerm]) -> PropositionTerm:
    """The disjunction, `or` (S2)."""
    return negation(conjunction([negation(operand) for operand in operands]))


def joined(node: Literal | Not | And | Or, operands: Sequence[PropositionTerm]) -> PropositionTerm:
    """The combination of some propositions (S2)."""
    match node:
        case Literal(value=value):
            return literal(value)
        case Not():
            return negation(operands[0])
        case And():
            return conjunction(operands)
        case Or():
            return disjunction(operands)


def constant(value: float) -> z3.ArithRef:
    """A finite double as an exact term."""
    return z3.RealVal(str(Fraction(value)))


def compared(comparison: Comparison, left: z3.ArithRef, right: z3.ArithRef) -> z3.BoolRef:
    """A comparison of two numbers (S27)."""
    match comparison:
        case Comparison.EQUAL:
            return left == right
        case Comparison.NOT_EQUAL:
            return left != right
        case Comparison.LESS:
            return left < right
        case Comparison.LESS_OR_EQUAL:
            return left <= right
        case Comparison.GREATER:
            return left > right
        case Comparison.GREATER_OR_EQUAL:
            return left >= right


def holds(node: Compare | Between | Flag, values: Sequence[z3.ArithRef]) -> z3.BoolRef:
    """The result of S27 to S29 for the numbers that a proposition compares (`compared_signals`),
    all known.
    """
    match node:
        case Compare(comparison=comparison):
            return compared(comparison, *values)
        case Between():
            return z3.And(values[1] <= values[0], values[0] <= values[2])
        case Flag():
            return values[0] != 0


def within(value: z3.ArithRef, ends: tuple[float, float]) -> list[z3.BoolRef]:
    """The facts that a number lies within two limits."""
    return [value >= constant(ends[0]), value <= constant(ends[1])]


def exact_number(value: z3.ExprRef) -> Fraction:
    """A number of a model, exact or approximated closely."""
    if z3.is_algebraic_value(value):
        value = value.approx(30)
    if z3.is_int_value(value):
        return Fraction(value.as_long())
    return value.as_fraction() if z3.is_rational_value(value) else Fraction(0)


def number_of(value: z3.ExprRef) -> float:
    """The double nearest to a number of a model."""
    return float(exact_number(value))


def extreme(values: Sequence[z3.ArithRef], *, least: bool) -> z3.ArithRef:
    """The least, or the greatest, of some numbers."""
    found = values[0]
    for value in values[1:]:
        found = z3.If(value < found if least else value > found, value, found)
    return found


def constants_in(term: z3.ExprRef) -> list[z3.ExprRef]:
    """All free constants in a term, each once."""
    found: dict[int, z3.ExprRef] = {}
    seen: set[int] = set()
    waiting = [term]
    while waiting:
        each = waiting.pop()
        if each.get_id() in seen:
            continue
        seen.add(each.get_id())
        if z3.is_const(each) and each.decl().kind() == z3.Z3_OP_UNINTERPRETED:
            found[each.get_id()] = each
        waiting += each.children()
    return list(found.values())
