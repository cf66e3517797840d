"""Conditions: rules S27 to S34 of docs/explanation/semantics.md."""

import math
from collections.abc import Sequence

from rossmarie.ir import (
    AgeReaches,
    Between,
    Change,
    Compare,
    Comparison,
    Count,
    FieldKind,
    Flag,
    Fold,
    Folding,
    Function,
    Held,
    Literal,
    Not,
    Or,
    Oscillates,
    Quantified,
    Quantifier,
    Sampled,
    Sampling,
    TruthValue,
)
from support.bench import Bench, reported
from support.drafts import SECOND, Draft
from support.machines import NAN

F, T, U, L = TruthValue


def test_s27_comparisons() -> None:
    draft = Draft()
    x, y = draft.read(), draft.read()
    propositions = [draft.proposition(Compare(comparison, x, y)) for comparison in Comparison]
    bench = Bench(draft)

    def of(a: float, b: float) -> list[TruthValue | None]:
        bench.send(0, c0=a, c1=b)
        return [bench.proposition(proposition) for proposition in propositions]

    assert of(1.0, 2.0) == [F, T, T, T, F, F]
    assert of(2.0, 1.0) == [F, T, F, F, T, T]
    assert of(0.0, -0.0) == [T, F, F, T, F, T]
    assert of(NAN, 1.0) == of(1.0, NAN) == of(NAN, NAN) == [U] * 6


def test_s28_ranges_include_both_ends() -> None:
    draft = Draft()
    x = draft.read()
    inside = draft.proposition(Between(x, draft.constant(-1.0), draft.constant(1.0)))
    bench = Bench(draft)
    seen = []
    for value in (-1.5, -1.0, 0.0, 1.0, 1.5, NAN):
        bench.send(0, c0=value)
        seen.append(bench.proposition(inside))
    assert seen == [F, T, T, T, F, U]


def test_s29_flags_and_texts() -> None:
    draft = Draft(texts=("docked", "driving"))
    flag = draft.proposition(Flag(draft.read(kind=FieldKind.FLAG)))
    mode = draft.read(kind=FieldKind.TEXT)
    docked = draft.proposition(Compare(Comparison.EQUAL, mode, draft.constant(0.0)))
    other = draft.proposition(Compare(Comparison.NOT_EQUAL, mode, draft.constant(0.0)))
    bench = Bench(draft)
    bench.advance(0)
    assert [bench.proposition(proposition) for proposition in (flag, docked, other)] == [U, U, U]
    bench.send(0, c0=1.0, c1=0.0)
    assert [bench.proposition(proposition) for proposition in (flag, docked, other)] == [T, T, F]
    bench.send(0, c0=0.0, c1=-1.0)
    assert [bench.proposition(proposition) for proposition in (flag, docked, other)] == [F, F, T]


def test_s30_stale_means_for_lack_of_an_input_with_a_timeout() -> None:
    draft = Draft()
    guarded, other = draft.read(timeout_ns=SECOND), draft.read()
    both = draft.proposition(Compare(Comparison.GREATER, guarded, other))
    bench = Bench(draft)
    bench.advance(0)
    assert bench.proposition(both) is L
    bench.send(0, c0=1.0)
    assert bench.proposition(both) is U
    bench.send(0.5, c1=0.0)
    assert bench.proposition(both) is T
    bench.advance(1)
    assert bench.proposition(both) is L


def test_s30_nan_from_a_guarded_input_is_stale() -> None:
    draft = Draft()
    positive = draft.above(draft.read(timeout_ns=SECOND), 0.0)
    bench = Bench(draft)
    bench.send(0, c0=NAN)
    assert bench.proposition(positive) is L


def test_s30_arithmetic_that_gives_no_number_from_a_guarded_input_is_stale() -> None:
    draft = Draft()
    guarded, other = draft.read(timeout_ns=SECOND), draft.read()
    alone = draft.above(draft.apply(Function.DIVIDE, guarded, guarded), 0.5)
    mixed = draft.above(draft.apply(Function.DIVIDE, other, guarded), 0.5)
    unguarded = draft.above(draft.apply(Function.DIVIDE, other, other), 0.5)
    bench = Bench(draft)
    bench.send(0, c0=0.0)
    assert (bench.proposition(alone), bench.proposition(mixed), bench.proposition(unguarded)) == (
        L,
        U,
        U,
    )
    bench.send(0, c1=0.0)
    assert (bench.proposition(alone), bench.proposition(mixed), bench.proposition(unguarded)) == (
        L,
        L,
        U,
    )
    bench.send(0, c0=1.0)
    assert (bench.proposition(alone), bench.proposition(mixed), bench.proposition(unguarded)) == (
        T,
        F,
        U,
    )


def test_s30_elements_out_of_range_are_not_a_lack() -> None:
    draft = Draft()
    least = draft.signal(Fold(Folding.MINIMUM, draft.elements(timeout_ns=SECOND)))
    nearer = draft.apply(Function.SUBTRACT, least, draft.constant(0.5))
    near = draft.above(nearer, 0.0)
    bench = Bench(draft)
    bench.send(0, c0=[math.inf])
    assert bench.proposition(near) is U
    bench.send(0, c0=[-math.inf])
    assert bench.proposition(near) is L


def test_s30_waiting_for_a_second_sample_is_not_stale() -> None:
    draft = Draft()
    rate = draft.signal(Sampled(Sampling.RATE, draft.read(timeout_ns=SECOND)))
    rising = draft.above(rate, 0.0)
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    assert bench.proposition(rising) is U
    bench.advance(1)
    assert bench.proposition(rising) is L


def test_s30_arrays_of_guarded_inputs() -> None:
    draft = Draft()
    element = draft.elements(timeout_ns=SECOND)
    least = draft.signal(Fold(Folding.MINIMUM, element))
    count = draft.signal(Count(draft.above(element, 0.0)))
    some = draft.proposition(Quantified(Quantifier.ANY, draft.above(element, 5.0)))
    propositions = [some, draft.above(least, 0.0), draft.above(count, 0.0)]
    waiting = draft.above(draft.signal(Sampled(Sampling.RATE, least)), 0.0)
    bench = Bench(draft)
    for elements in ([], [NAN]):
        bench.send(0, c0=elements)
        assert [bench.proposition(proposition) for proposition in propositions] == [L, L, L]
    bench.send(0.5, c0=[1.0])
    assert [bench.proposition(proposition) for proposition in propositions] == [F, T, T]
    assert bench.proposition(waiting) is U


def test_s31_age_grows_on_after_expiry() -> None:
    draft = Draft()
    draft.read(timeout_ns=SECOND)
    old = draft.proposition(AgeReaches(0, 3 * SECOND))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    bench.monitor.advance(3 * SECOND - 1)
    assert bench.proposition(old) is F
    bench.advance(3)
    assert bench.proposition(old) is T
    bench.send(4, c0=NAN)
    assert bench.proposition(old) is F


def test_s31_age_is_unknown_before_the_first_message() -> None:
    draft = Draft()
    draft.read(timeout_ns=SECOND)
    draft.read()
    guarded, other = (draft.proposition(AgeReaches(used, SECOND)) for used in (0, 1))
    bench = Bench(draft)
    bench.advance(0)
    assert (bench.proposition(guarded), bench.proposition(other)) == (L, U)


def shaken(values: Sequence[float], count: int, swing: float) -> list[TruthValue | None]:
    draft = Draft()
    proposition = draft.proposition(Oscillates(draft.read(), count, 100 * SECOND, swing))
    bench = Bench(draft)
    seen = []
    for second, value in enumerate(values):
        bench.send(second, c0=value)
        seen.append(bench.proposition(proposition))
    return seen


def test_s32_turning_points() -> None:
    #         start up   up   turn  down  turn  turn
    values = (0.0, 1.0, 2.0, 1.0, 0.5, 3.0, 2.0)
    assert shaken(values, 1, 0.0) == [F, F, F, T, T, T, T]
    assert shaken(values, 3, 0.0) == [F, F, F, F, F, F, T]


def test_s32_small_swings_do_not_count() -> None:
    # Neither do swings of just the given size: they have to be larger.
    assert shaken((0.0, 5.0, 4.0, 5.0, 4.0), 1, 1.0) == [F] * 5
    assert shaken((0.0, -5.0, -4.0, -5.0, -4.0), 1, 1.0) == [F] * 5
    assert shaken((0.0, 1.0, 0.0, 0.5, -0.5), 1, 1.0) == [F] * 5
    assert shaken((0.0, 0.5, -0.5, 5.0, 3.0), 1, 1.0) == [F, F, F, F, T]


def test_s32_the_window_closes() -> None:
    draft = Draft()
    proposition = draft.proposition(Oscillates(draft.read(), 2, 2 * SECOND, 0.0))
    bench = Bench(draft)
    for second, value in ((0, 0.0), (1, 1.0), (2, 0.0), (3, 1.0)):
        bench.send(second, c0=value)
    assert bench.proposition(proposition) is T
    assert bench.wake() == 4.0  # the turning points were at 2 and 3
    bench.advance(4)
    assert bench.proposition(proposition) is F
    assert bench.wake() is None


def test_s32_unknown_forgets_turning_points() -> None:
    assert shaken((0.0, 1.0, 0.0, NAN, 1.0, 0.0, 1.0), 1, 0.0) == [F, F, T, U, U, U, T]


def test_s32_after_a_gap_it_is_false_once_it_was_known_throughout_the_window() -> None:
    draft = Draft()
    shaking = draft.proposition(Oscillates(draft.read(timeout_ns=SECOND), 1, 3 * SECOND, 0.0))
    draft.rule(shaking)
    bench = Bench(draft)
    for second, x in enumerate((0.0, 1.0, 0.0)):
        bench.send(second / 2, c0=x)
    assert bench.monitor.active == (True,)
    assert bench.send(1.5, c0=NAN) == []
    assert bench.send(2, c0=0.0) == []
    assert bench.proposition(shaking) is L
    bench.send(2.9, c0=0.0)
    assert bench.wake() == 3.9
    bench.send(3.8, c0=0.0)
    assert bench.send(4.7, c0=0.0) == []
    assert reported(bench.advance(5)) == [(0, 5.0, Change.CLEARED)]


def test_s33_for_matures_at_its_own_instant() -> None:
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    held = draft.proposition(Held(positive, 2 * SECOND))
    bench = Bench(draft)
    bench.send(0, c0=-1.0)
    assert bench.proposition(held) is F
    bench.send(1, c0=1.0)
    bench.send(2, c0=5.0)
    assert bench.proposition(held) is F
    bench.advance(3)
    assert bench.proposition(held) is T
    bench.send(4, c0=-1.0)
    assert bench.proposition(held) is F


def test_s33_unknown_breaks_it() -> None:
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    held = draft.proposition(Held(positive, 2 * SECOND))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    bench.send(1, c0=NAN)
    assert bench.proposition(held) is U
    bench.send(1.5, c0=1.0)
    bench.advance(3)
    assert bench.proposition(held) is U
    bench.advance(3.5)
    assert bench.proposition(held) is T


def test_s33_until_it_matures_it_is_what_the_condition_was_before() -> None:
    draft = Draft()
    positive = draft.above(draft.read(timeout_ns=SECOND), 0.0)
    held = draft.proposition(Held(positive, 2 * SECOND))
    bench = Bench(draft)
    bench.send(0, c0=-1.0)
    bench.send(0.5, c0=1.0)
    assert bench.proposition(held) is F
    bench.advance(2)
    assert bench.proposition(held) is L
    bench.send(2, c0=1.0)
    assert bench.proposition(held) is L
    assert bench.wake() == 3.0
    bench.send(2.5, c0=-1.0)
    assert bench.proposition(held) is F


def test_s33_a_dropout_does_not_clear_a_rule_whose_condition_goes_on() -> None:
    draft = Draft()
    tilted = draft.above(draft.read(timeout_ns=SECOND), 0.0)
    draft.rule(draft.proposition(Held(tilted, SECOND)))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    bench.send(0.9, c0=1.0)
    assert reported(bench.send(1.0, c0=1.0)) == [(0, 1.0, Change.ACTIVATED)]
    assert bench.send(1.2, c0=NAN) == []
    assert bench.send(1.3, c0=1.0) == []
    assert reported(bench.send(1.4, c0=-1.0)) == [(0, 1.4, Change.CLEARED)]


def test_s33_nothing_has_held_before_the_start() -> None:
    draft = Draft()
    always = draft.proposition(Literal(True))
    held = draft.proposition(Held(always, SECOND))
    bench = Bench(draft)
    bench.advance(100)
    assert bench.proposition(held) is F
    bench.advance(101)
    assert bench.proposition(held) is T


def test_s33_nested() -> None:
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    inner = draft.proposition(Held(positive, SECOND))
    calm = draft.proposition(Held(draft.proposition(Not(inner)), 2 * SECOND))
    bench = Bench(draft)
    bench.send(0, c0=-1.0)
    bench.advance(2)
    assert bench.proposition(calm) is T
    bench.send(3, c0=1.0)
    assert bench.proposition(calm) is T
    bench.advance(4)
    assert bench.proposition(calm) is F


def test_s34_since_when() -> None:
    draft = Draft()
    positive = draft.above(draft.read(timeout_ns=SECOND), 0.0)
    draft.rule(draft.proposition(Or((positive, draft.proposition(Not(positive))))))
    bench = Bench(draft)

    def since() -> float:
        return bench.monitor._memory.since_ns[positive] / SECOND

    seen = []
    for second, value in ((1, 2.0), (1.5, 3.0), (2, -1.0), (2.5, -2.0)):
        bench.send(second, c0=value)
        seen.append(since())
    bench.advance(9)
    assert [*seen, since()] == [1.0, 1.0, 2.0, 2.0, 3.5]
