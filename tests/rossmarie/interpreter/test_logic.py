"""Proposition and logic: rules S1 and S2 of docs/explanation/semantics.md."""

from rossmarie.ir import TruthValue
from rossmarie.ir.kleene import conjunction, disjunction, negation

F, T, U, L = TruthValue


def test_s1_the_four_values_have_their_numbers() -> None:
    assert [value.name for value in sorted(TruthValue)] == ["FALSE", "TRUE", "UNKNOWN", "STALE"]
    assert list(map(int, (F, T, U, L))) == [0, 1, 2, 3]


def test_s2_not() -> None:
    assert list(map(negation, (F, T, U, L))) == [T, F, U, L]


def test_s2_and() -> None:
    table = [[conjunction((a, b)) for b in (F, T, U, L)] for a in (F, T, U, L)]
    assert table == [[F, F, F, F], [F, T, U, L], [F, U, U, L], [F, L, L, L]]


def test_s2_or() -> None:
    table = [[disjunction((a, b)) for b in (F, T, U, L)] for a in (F, T, U, L)]
    assert table == [[F, T, U, L], [T, T, T, T], [U, T, U, L], [L, T, L, L]]
