"""Conditions over time: rules S44 to S46 of docs/explanation/semantics.md."""

from collections.abc import Callable
from itertools import product

import pytest

from rossmarie.ir import And, Change, Held, Not, Since, TruthValue, kleene
from support.bench import Bench, reported
from support.drafts import SECOND, Draft
from support.machines import NAN

F, T, U, L = TruthValue


def once(draft: Draft, condition: int, seconds: float) -> int:
    """`once condition within seconds`, as lowering defines it."""
    never = draft.proposition(Not(condition))
    held = draft.proposition(Held(never, round(seconds * SECOND), initially=True))
    return draft.proposition(Not(held))


def response(draft: Draft, cause: int, answer: int, seconds: float) -> int:
    """`after cause, answer within seconds`, as lowering defines it."""
    missing = draft.proposition(Not(answer))
    pending = draft.proposition(Since(missing, draft.proposition(And((cause, missing)))))
    return draft.proposition(Not(draft.proposition(Held(pending, round(seconds * SECOND)))))


# --- since -------------------------------------------------------------------------------------


def test_s44_b_begins_and_a_goes_on() -> None:
    draft = Draft()
    a, b = (draft.above(draft.read(), 0.0) for _ in "ab")
    since = draft.proposition(Since(a, b))
    bench = Bench(draft)
    seen = []
    steps = ((1, -1), (-1, 1), (1, -1), (1, -1), (-1, -1), (1, -1), (1, 1), (-1, 1))
    for at, (held, begun) in enumerate(steps):
        bench.send(at, c0=float(held), c1=float(begun))
        seen.append(bench.proposition(since))
    # Nothing has held before the start; B alone begins; A goes on until it is false.
    assert seen == [F, T, T, T, F, F, T, T]


def test_s44_what_is_not_known_stays_unknown_until_b_is_true_or_a_false() -> None:
    draft = Draft()
    a, b = (draft.above(draft.read(), 0.0) for _ in "ab")
    since = draft.proposition(Since(a, b))
    bench = Bench(draft)
    seen = []
    steps = ((1.0, 1.0), (NAN, -1.0), (1.0, -1.0), (-1.0, -1.0), (1.0, NAN), (1.0, 1.0))
    for at, (held, begun) in enumerate(steps):
        bench.send(at, c0=held, c1=begun)
        seen.append(bench.proposition(since))
    assert seen == [T, U, U, F, U, T]


@pytest.mark.parametrize("before", TruthValue)
@pytest.mark.parametrize("begun", TruthValue)
@pytest.mark.parametrize("held", TruthValue)
def test_s44_evaluating_again_changes_nothing(
    held: TruthValue, begun: TruthValue, before: TruthValue
) -> None:
    def value(memory: TruthValue) -> TruthValue:
        going_on = kleene.conjunction((held, kleene.disjunction((begun, memory))))
        return kleene.disjunction((begun, going_on))

    assert value(value(before)) is value(before)


def test_s44_wakes_in_between_change_nothing() -> None:
    draft = Draft()
    a, b, other = (draft.above(draft.read(timeout_ns=SECOND), 0.0) for _ in range(3))
    since = draft.proposition(Since(a, b))
    draft.proposition(Held(other, SECOND // 4))
    bench = Bench(draft)
    bench.send(0, c1=NAN, c2=1.0)  # A stale, B stale
    before = bench.proposition(since)
    bench.advance(0.25)
    assert (before, bench.proposition(since)) == (L, L)


def test_s44_unknown_beside_stale_is_stale_at_once() -> None:
    draft = Draft()
    a = draft.above(draft.read(timeout_ns=SECOND), 0.0)
    b = draft.above(draft.read(), 0.0)
    since = draft.proposition(Since(a, b))
    bench = Bench(draft)
    bench.advance(0)
    assert bench.proposition(since) is L


def test_s44_it_outlasts_a_jump() -> None:
    draft = Draft()
    a, b = (draft.above(draft.read(), 0.0) for _ in "ab")
    since = draft.proposition(Since(a, b))
    bench = Bench(draft)
    bench.send(10, c0=1.0, c1=1.0)
    bench.send(11, c1=-1.0)
    bench.send(5, c0=1.0)
    assert bench.proposition(since) is T
    bench.send(6, c0=-1.0)
    bench.send(2, c0=1.0)
    assert bench.proposition(since) is F


# --- once --------------------------------------------------------------------------------------


def test_s45_once_within() -> None:
    draft = Draft()
    seen = once(draft, draft.above(draft.read(), 0.0), 2)
    bench = Bench(draft)
    bench.send(0, c0=-1.0)
    assert bench.proposition(seen) is F  # it was never true before the start
    bench.send(1, c0=1.0)
    assert bench.proposition(seen) is T
    bench.send(2, c0=-1.0)
    assert bench.proposition(seen) is T
    assert bench.wake() == 4.0
    bench.send(3.9, c0=-1.0)
    assert bench.proposition(seen) is T
    bench.advance(4)
    assert bench.proposition(seen) is F


def test_s45_what_counts_as_true_before_the_start_needs_no_wake() -> None:
    draft = Draft()
    once(draft, draft.above(draft.read(), 0.0), 2)
    bench = Bench(draft)
    bench.send(0, c0=-1.0)
    assert bench.wake() is None


def test_s45_unknown_lasts_for_the_window() -> None:
    draft = Draft()
    seen = once(draft, draft.above(draft.read(), 0.0), 2)
    bench = Bench(draft)
    bench.send(0, c0=NAN)
    assert bench.proposition(seen) is U
    bench.send(1, c0=-1.0)
    assert bench.proposition(seen) is U  # it may have been true just before
    bench.advance(3)
    assert bench.proposition(seen) is F


def test_s45_after_a_jump_it_is_unknown_for_the_window() -> None:
    draft = Draft()
    seen = once(draft, draft.above(draft.read(), 0.0), 2)
    bench = Bench(draft)
    bench.send(10, c0=-1.0)
    bench.send(5, c0=-1.0)
    assert bench.proposition(seen) is U
    bench.advance(7)
    assert bench.proposition(seen) is F


# --- after -------------------------------------------------------------------------------------


def test_s46_the_answer_at_the_last_instant_is_in_time() -> None:
    draft = Draft()
    a, b = (draft.above(draft.read(), 0.0) for _ in "ab")
    kept = response(draft, a, b, 2)
    draft.rule(draft.proposition(Not(kept)))
    bench = Bench(draft)
    bench.send(0, c0=-1.0, c1=-1.0)
    bench.send(1, c0=1.0)
    bench.send(1.5, c0=-1.0)
    assert bench.proposition(kept) is T
    assert bench.send(3, c1=1.0) == []
    assert bench.proposition(kept) is T


def test_s46_false_while_an_answer_is_overdue() -> None:
    draft = Draft()
    a, b = (draft.above(draft.read(), 0.0) for _ in "ab")
    kept = response(draft, a, b, 2)
    draft.rule(draft.proposition(Not(kept)))
    bench = Bench(draft)
    bench.send(0, c0=-1.0, c1=-1.0)
    bench.send(1, c0=1.0)
    bench.send(1.5, c0=-1.0)
    assert reported(bench.advance(5)) == [(0, 3.0, Change.ACTIVATED)]
    assert bench.proposition(kept) is F
    assert reported(bench.send(6, c1=1.0)) == [(0, 6.0, Change.CLEARED)]


def test_s46_a_cause_that_goes_on_asks_at_each_instant() -> None:
    draft = Draft()
    a, b = (draft.above(draft.read(), 0.0) for _ in "ab")
    kept = response(draft, a, b, 2)
    bench = Bench(draft)
    bench.send(0, c0=1.0, c1=1.0)
    bench.send(3, c1=-1.0)
    assert bench.proposition(kept) is T
    bench.advance(5)
    assert bench.proposition(kept) is F


def test_s46_an_unknown_cause_leaves_it_unknown_until_the_answer() -> None:
    draft = Draft()
    a, b = (draft.above(draft.read(), 0.0) for _ in "ab")
    kept = response(draft, a, b, 2)
    bench = Bench(draft)
    bench.send(0, c0=NAN, c1=-1.0)
    bench.send(1, c0=-1.0)
    bench.advance(100)
    assert bench.proposition(kept) is U
    bench.send(101, c1=1.0)
    assert bench.proposition(kept) is T


# --- definitions on traces -----------------------------------------------------------------------

_LENGTHS = (1, 2, 3, 4)
_WINDOW = 2  # seconds, and steps
_History = tuple[bool, ...]


def _since(a: _History, b: _History) -> bool:
    return any(b[i] and all(a[i + 1 :]) for i in range(len(a)))


def _once(a: _History, _: _History) -> bool:
    """A was true at some instant in (t - T, t]; from one step to the next it is what it was."""
    return any(a[-_WINDOW - 1 :])


def _kept(a: _History, b: _History) -> bool:
    """No instant at which A was true, and B was not from there on, is T ago or longer."""
    return not any(a[i] and not any(b[i:]) for i in range(len(a) - _WINDOW))


def _possible(values: tuple[TruthValue, ...]) -> list[_History]:
    """All that may have been the case where something is unknown."""
    return list(product(*((False, True) if value is U else (value is T,) for value in values)))


def _compare(
    operator: Callable[[Draft, int, int], int],
    meant: Callable[[_History, _History], bool],
    length: int,
) -> None:
    """On each trace of so many steps what is true or false is so for all that the unknown may have
    been, and where nothing is unknown, neither is the outcome.
    """
    draft = Draft()
    a, b = (draft.above(draft.read(), 0.0) for _ in "ab")
    proposition = operator(draft, a, b)
    numbers = {F: -1.0, T: 1.0, U: NAN}
    histories = list(product(numbers, repeat=length))
    for one, other in product(histories, histories):
        bench = Bench(draft)
        for at in range(length):
            bench.send(at, c0=numbers[one[at]], c1=numbers[other[at]])
        found = bench.proposition(proposition)
        outcomes = {meant(x, y) for x in _possible(one) for y in _possible(other)}
        assert found is U or outcomes == {found is T}, (one, other)
        assert found is not U or U in (*one, *other), (one, other)


@pytest.mark.parametrize("length", _LENGTHS)
def test_s44_on_all_short_traces(length: int) -> None:
    _compare(lambda draft, a, b: draft.proposition(Since(a, b)), _since, length)


@pytest.mark.parametrize("length", _LENGTHS)
def test_s45_on_all_short_traces(length: int) -> None:
    _compare(lambda draft, a, _: once(draft, a, _WINDOW), _once, length)


@pytest.mark.parametrize("length", _LENGTHS)
def test_s46_on_all_short_traces(length: int) -> None:
    _compare(lambda draft, a, b: response(draft, a, b, _WINDOW), _kept, length)
