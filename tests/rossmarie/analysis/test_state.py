"""Possible states at an evaluation, including the special values of doubles."""

from __future__ import annotations

import math
from functools import partial

import pytest
import z3

from rossmarie import ir
from rossmarie.analysis.inquiry import Inquiry
from rossmarie.analysis.state import ArbitraryState
from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, TruthValue
from support.drafts import SECOND, Draft


def has(state: ArbitraryState, proposition: int, value: TruthValue) -> z3.BoolRef:
    return state.proposition(proposition).is_value(value)


def is_impossible(draft: Draft, proposition: int, value: TruthValue) -> bool:
    return Inquiry(draft.machine()).is_impossible(
        partial(has, proposition=proposition, value=value)
    )


def seen(draft: Draft, proposition: int, *slots: float) -> TruthValue:
    machine = draft.machine()
    monitor = Interpreter(machine.__class__(**{**vars(machine), "watches": (proposition,)}))
    monitor.update(0, {0: ChannelValues(dict(enumerate(slots)), {0: list(slots)})})
    return monitor.watches[0]


def test_a_sum_may_be_rounded_to_one_of_its_parts() -> None:
    draft = Draft()
    x = draft.read()
    more = draft.apply(ir.Function.ADD, x, draft.constant(1.0))
    is_more = draft.proposition(ir.Compare(ir.Comparison.GREATER, more, x))
    assert seen(draft, is_more, 1e300) is TruthValue.FALSE
    assert not is_impossible(draft, is_more, TruthValue.FALSE)
    is_less = draft.proposition(ir.Compare(ir.Comparison.LESS, more, draft.constant(-1e308)))
    both = draft.proposition(ir.And((is_less, draft.above(x, 0.0))))
    assert is_impossible(draft, both, TruthValue.TRUE)


@pytest.mark.parametrize("timeout_ns", [None, SECOND])
def test_a_product_may_be_too_large(timeout_ns: int | None) -> None:
    draft = Draft()
    x = draft.read(timeout_ns)
    unknown = TruthValue.UNKNOWN if timeout_ns is None else TruthValue.STALE
    square = draft.apply(ir.Function.MULTIPLY, x, x)
    known = draft.above(x, 0.0)
    stale = draft.proposition(ir.Not(draft.above(square, 0.0)))
    assert seen(draft, stale, 1e200) is unknown
    state = ArbitraryState(Inquiry(draft.machine()).asked)
    predicate = z3.And(state.proposition(known).true, state.proposition(stale).is_value(unknown))
    assert (
        Inquiry(draft.machine()).is_impossible(lambda _: z3.And(predicate, *state.facts)) is False
    )


def test_an_orientation_of_zeros_has_no_angle() -> None:
    draft = Draft()
    used = draft.input(draft.channel(), SECOND)
    parts = [draft.signal(ir.Read(draft.slot(used))) for _ in range(4)]
    level = draft.proposition(
        ir.Compare(ir.Comparison.LESS, draft.apply(ir.Function.PITCH, *parts), draft.constant(2.0))
    )
    assert seen(draft, level, 0.0, 0.0, 0.0, 0.0) is TruthValue.STALE
    state = ArbitraryState(Inquiry(draft.machine()).asked)
    predicate = z3.And(
        state.proposition(level).stale, *(state.signal(part).known for part in parts), *state.facts
    )
    assert not Inquiry(draft.machine()).is_impossible(lambda _: predicate)
    assert is_impossible(draft, level, TruthValue.FALSE)


@pytest.mark.parametrize(
    ("element", "value"), [(math.inf, TruthValue.UNKNOWN), (-math.inf, TruthValue.STALE)]
)
def test_arithmetic_with_an_infinite_element_is_unknown_or_stale(
    element: float, value: TruthValue
) -> None:
    draft = Draft()
    least = draft.signal(ir.Fold(ir.Folding.MINIMUM, draft.elements(SECOND)))
    nearer = draft.apply(ir.Function.SUBTRACT, least, draft.constant(1.0))
    is_near = draft.above(nearer, 0.0)
    is_there = draft.proposition(ir.Compare(ir.Comparison.EQUAL, least, least))
    assert seen(draft, is_near, element) is value
    both = ArbitraryState(Inquiry(draft.machine()).asked)
    predicate = z3.And(
        both.proposition(is_there).true, both.proposition(is_near).is_value(value), *both.facts
    )
    assert not Inquiry(draft.machine()).is_impossible(lambda _: predicate)


def test_two_durations_of_nested_limits_are_compared() -> None:
    draft = Draft()
    x = draft.read()
    high, low = draft.above(x, 2.0), draft.above(x, 1.0)
    long = draft.proposition(ir.Held(high, 3 * SECOND))
    short = draft.proposition(ir.Held(low, 2 * SECOND))
    first = draft.proposition(ir.And((long, draft.proposition(ir.Not(short)))))
    assert is_impossible(draft, first, TruthValue.TRUE)
    second = draft.proposition(ir.And((short, draft.proposition(ir.Not(long)))))
    assert not is_impossible(draft, second, TruthValue.TRUE)
