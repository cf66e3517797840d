"""Time and events: rules S11 to S17 of docs/explanation/semantics.md."""

import math

import pytest
from hypothesis import given, settings

from rossmarie.interpreter import Interpreter
from rossmarie.ir import (
    AgeReaches,
    Change,
    Compare,
    Comparison,
    Event,
    Held,
    Oscillates,
    Sampled,
    Sampling,
    TimeJump,
    TruthValue,
    Verdict,
)
from support.bench import Bench, reported
from support.depth import examples
from support.drafts import SECOND, Draft
from support.machines import Case, Step, cases, exactly, take

F, T, U, L = TruthValue


def test_s11_messages_of_one_update_are_seen_together() -> None:
    draft = Draft()
    x, y = draft.read(), draft.read()
    draft.rule(draft.proposition(Compare(Comparison.GREATER, x, y)))
    bench = Bench(draft)
    assert bench.send(0, c0=1.0, c1=2.0) == []
    assert bench.send(1, c0=3.0, c1=4.0) == []  # one by one, 3 > 2 would show


def test_s12_nothing_happens_before_the_first_event() -> None:
    draft = Draft()
    draft.rule(draft.above(draft.read(timeout_ns=SECOND), 0.0))
    bench = Bench(draft)
    assert bench.monitor.active == (False,)
    assert bench.wake() is None


@pytest.mark.parametrize("first", ["update", "advance", "reset"])
def test_s12_guarded_rules_are_active_until_their_input_arrives(first: str) -> None:
    draft = Draft()
    guarded, other = draft.read(timeout_ns=SECOND), draft.read()
    draft.rule(draft.above(guarded, 0.0))
    draft.rule(draft.above(other, 0.0))
    draft.channel()
    bench = Bench(draft)
    step = {"update": lambda: bench.send(0, c2=0.0), "advance": lambda: bench.advance(0)}
    events = step.get(first, lambda: bench.reset(0))()
    assert reported(events) == [(0, 0.0, Change.ACTIVATED_STALE)]
    assert reported(bench.send(0.5, c0=-1.0)) == [(0, 0.5, Change.CLEARED)]


def test_s13_wakes_before_an_event_are_run_at_their_own_instants() -> None:
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    early = draft.proposition(Held(positive, 2 * SECOND))
    late = draft.proposition(Held(early, SECOND))
    for proposition in (early, late):
        draft.rule(proposition)
    bench = Bench(draft)
    assert bench.send(0, c0=1.0) == []
    assert reported(bench.send(10, c0=-1.0)) == [
        (0, 2.0, Change.ACTIVATED),
        (1, 3.0, Change.ACTIVATED),
        (0, 10.0, Change.CLEARED),
        (1, 10.0, Change.CLEARED),
    ]


def test_s14_an_update_and_a_wake_at_one_instant_are_one_evaluation() -> None:
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    draft.rule(draft.proposition(Held(positive, 2 * SECOND)))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    assert bench.send(2, c0=-1.0) == []


def test_s14_advance_includes_its_instant() -> None:
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    draft.rule(draft.proposition(Held(positive, 2 * SECOND)))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    assert bench.monitor.advance(2 * SECOND - 1) == []
    assert reported(bench.advance(2)) == [(0, 2.0, Change.ACTIVATED)]


def test_s15_the_next_wake_is_the_earliest_timer() -> None:
    draft = Draft()
    x = draft.read(timeout_ns=9 * SECOND)
    positive = draft.above(x, 0.0)
    draft.proposition(Held(positive, 3 * SECOND))
    draft.proposition(AgeReaches(0, 5 * SECOND))
    draft.proposition(Oscillates(x, 1, 7 * SECOND, 0.0))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    bench.send(0, c0=2.0)
    bench.send(0, c0=1.0)
    wakes = []
    while (wake := bench.wake()) is not None:
        wakes.append(wake)
        bench.advance(wake)
    assert wakes == [3.0, 5.0, 7.0, 9.0]


@settings(max_examples=examples(2))
@given(cases())
def test_s15_a_wake_lies_ahead(case: Case) -> None:
    machine, trace = case
    monitor = Interpreter(machine)
    for step in trace:
        take(monitor, step)
        wake_ns = monitor.next_wake()
        assert wake_ns is None or wake_ns > step.at_ns


@settings(max_examples=examples(2))
@given(cases())
def test_s15_waking_in_between_changes_nothing(case: Case) -> None:
    """A caller that obeys the wakes, and even looks in between, sees the same as other callers."""
    machine, trace = case
    lazy, eager = Interpreter(machine), Interpreter(machine)
    for step in trace:
        seen = [] if step is trace[0] else woken(eager, step)
        seen += take(eager, step)
        assert [exactly(event) for event in seen] == [exactly(e) for e in take(lazy, step)]
        assert eager.active == lazy.active


def woken(monitor: Interpreter, before: Step) -> list[Event]:
    events: list[Event] = []
    while (wake_ns := monitor.next_wake()) is not None and wake_ns < before.at_ns:
        events += monitor.advance(wake_ns - 1)
        events += monitor.advance(wake_ns)
    return events


def test_s16_updates_at_one_instant_are_evaluated_one_by_one() -> None:
    draft = Draft()
    draft.rule(draft.above(draft.read(), 0.0))
    bench = Bench(draft)
    events = [event for x in (1.0, -1.0, 1.0) for event in bench.send(4, c0=x)]
    assert reported(events) == [
        (0, 4.0, Change.ACTIVATED),
        (0, 4.0, Change.CLEARED),
        (0, 4.0, Change.ACTIVATED),
    ]


def test_s17_a_jump_is_reported_and_restarts_durations() -> None:
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    draft.rule(draft.proposition(Held(positive, 2 * SECOND)))
    bench = Bench(draft)
    bench.send(10, c0=1.0)
    bench.advance(13)
    events = bench.send(5, c0=1.0)
    assert events == [TimeJump(13 * SECOND, 5 * SECOND)]  # nobody knows what was in between
    assert bench.monitor.active == (True,)
    (cleared,) = bench.send(6, c0=-1.0)
    assert isinstance(cleared, Verdict)
    assert cleared.since_ns == (6 * SECOND, 6 * SECOND)
    bench.send(7, c0=1.0)
    assert reported(bench.advance(20)) == [(0, 9.0, Change.ACTIVATED)]


def test_s17_inputs_keep_their_ages() -> None:
    draft = Draft()
    x = draft.read(timeout_ns=SECOND)
    old = draft.proposition(AgeReaches(0, SECOND // 2))
    bench = Bench(draft)
    bench.send(10, c0=1.0)
    bench.advance(10.75)
    assert bench.proposition(old) is T
    bench.advance(3)
    assert bench.proposition(old) is T
    assert bench.signal(x) == 1.0
    assert bench.wake() == 3.25


def test_s17_repeated_jumps_do_not_keep_a_silent_input_alive() -> None:
    draft = Draft()
    draft.rule(draft.above(draft.read(timeout_ns=SECOND), 0.0))
    bench = Bench(draft)
    bench.send(0, c0=-1.0)
    events = [event for at in (0.75, 0.5, 1.25) for event in bench.advance(at)]
    assert reported(events) == [(0, 0.75, Change.ACTIVATED_STALE)]


def test_s17_expired_inputs_stay_expired() -> None:
    draft = Draft()
    x = draft.read(timeout_ns=SECOND)
    older = draft.proposition(AgeReaches(0, 12 * SECOND))
    draft.rule(draft.above(x, 0.0))
    bench = Bench(draft)
    bench.send(10, c0=1.0)
    bench.advance(20)
    assert bench.proposition(older) is F
    bench.advance(4)
    assert math.isnan(bench.signal(x))
    assert bench.wake() == 6.0
    bench.advance(6)
    assert bench.proposition(older) is T


def test_s17_ages_do_not_overflow_however_often_time_jumps() -> None:
    draft = Draft()
    x = draft.read()
    old = draft.proposition(AgeReaches(0, SECOND))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    for _ in range(8):
        bench.monitor.advance(2**62 - 1)
        bench.monitor.advance(-(2**61) + 1)
    assert bench.proposition(old) is T
    assert bench.signal(x) == 1.0


def test_s17_samples_are_forgotten() -> None:
    draft = Draft()
    x = draft.read()
    rate, previous = (
        draft.signal(Sampled(Sampling.RATE, x)),
        draft.signal(Sampled(Sampling.PREVIOUS, x)),
    )
    shaking = draft.proposition(Oscillates(x, 1, 100 * SECOND, 0.0))
    bench = Bench(draft)
    for second, value in enumerate((1.0, 2.0, 1.0)):
        bench.send(second, c0=value)
    assert (bench.signal(rate), bench.signal(previous), bench.proposition(shaking)) == (
        -1.0,
        2.0,
        T,
    )
    bench.send(0, c0=3.0)
    assert math.isnan(bench.signal(rate))
    assert math.isnan(bench.signal(previous))
    assert bench.proposition(shaking) is U


def test_s17_after_a_jump_the_next_message_is_the_first_sample() -> None:
    draft = Draft()
    shaking = draft.proposition(Oscillates(draft.read(), 1, 100 * SECOND, 0.0))
    bench = Bench(draft)
    bench.send(10, c0=5.0)
    bench.advance(0)
    bench.send(1, c0=1.0)  # would be on its way down from 5
    bench.send(2, c0=2.0)
    assert bench.proposition(shaking) is U
    bench.send(3, c0=1.0)
    assert bench.proposition(shaking) is T


def test_s17_rules_keep_their_state_until_evaluated() -> None:
    draft = Draft()
    draft.rule(draft.above(draft.read(), 0.0))
    bench = Bench(draft)
    bench.send(10, c0=1.0)
    assert reported(bench.advance(5)) == []
    assert bench.monitor.active == (True,)


@pytest.mark.parametrize("at_ns", [-(2**61), 2**62])
def test_instants_out_of_range_are_refused(at_ns: int) -> None:
    monitor = Interpreter(Draft().machine())
    with pytest.raises(ValueError, match="out of range"):
        monitor.advance(at_ns)
