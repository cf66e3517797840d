"""Kleene's logic over false, true, unknown and stale (rules S1 and S2)."""

from __future__ import annotations

from collections.abc import Iterable

from rossmarie.ir.verdict import TruthValue

_NEGATED = {TruthValue.FALSE: TruthValue.TRUE, TruthValue.TRUE: TruthValue.FALSE}


def proposition_of(value: bool) -> TruthValue:
    """The truth value of a Boolean."""
    return TruthValue.TRUE if value else TruthValue.FALSE


def negation(operand: TruthValue) -> TruthValue:
    """`not`: unknown stays unknown."""
    return _NEGATED.get(operand, operand)


def conjunction(operands: Iterable[TruthValue]) -> TruthValue:
    """`and`: false if any operand is false, else the greatest operand."""
    values = tuple(operands)
    return TruthValue.FALSE if TruthValue.FALSE in values else max(values, default=TruthValue.TRUE)


def disjunction(operands: Iterable[TruthValue]) -> TruthValue:
    """`or`: true if any operand is true, else the greatest operand."""
    values = tuple(operands)
    return TruthValue.TRUE if TruthValue.TRUE in values else max(values, default=TruthValue.FALSE)
