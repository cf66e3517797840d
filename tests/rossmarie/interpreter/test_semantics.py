"""Each rule of docs/explanation/semantics.md, on the smallest machine that shows it."""

import math
from collections.abc import Sequence

import pytest
from hypothesis import given, settings

from rossmarie.interpreter import Interpreter
from rossmarie.ir import (
    AgeReaches,
    And,
    Between,
    Change,
    ChannelValues,
    Compare,
    Comparison,
    Count,
    Event,
    Flag,
    Fold,
    Folding,
    Function,
    Held,
    InputState,
    Kind,
    Literal,
    Not,
    Or,
    Oscillates,
    Previous,
    Quantified,
    Quantifier,
    Rate,
    Read,
    TimeJump,
    TruthValue,
    Verdict,
    verify,
)
from rossmarie.ir.kleene import conjunction, disjunction, negation
from support.drafts import SECOND, Draft
from support.machines import Step, Update, cases, exactly, observe, take

NAN = math.nan
INFINITY = math.inf
F, T, U, L = TruthValue

Value = float | Sequence[float]

UPRIGHT = (0.43788759365057206, 0.49581224138185065)
"""x and y of an orientation (x, y, -x, y) whose pitch rounding takes beyond the range of asin."""


class Bench:
    """A monitor under test. Slots and arrays are fed by channel, instants are in seconds."""

    def __init__(self, draft: Draft) -> None:
        machine = draft.machine()
        verify(machine)
        self.machine = machine
        self.monitor = Interpreter(machine)

    def send(self, seconds: float, **values: Value) -> list[Event]:
        """Messages by channel, `c0=3.0` or `c0=[1.0, 2.0]`."""
        messages = {int(name[1:]): self._message(int(name[1:]), v) for name, v in values.items()}
        return self.monitor.update(ns(seconds), messages)

    def _message(self, channel: int, value: Value) -> ChannelValues:
        def belongs(index: int) -> bool:
            return self.machine.inputs[index].channel == channel

        if isinstance(value, float):
            slots = [i for i, slot in enumerate(self.machine.slots) if belongs(slot.input)]
            return ChannelValues(slots=dict.fromkeys(slots, value))
        arrays = [i for i, array in enumerate(self.machine.arrays) if belongs(array.input)]
        return ChannelValues(arrays=dict.fromkeys(arrays, value))

    def advance(self, seconds: float) -> list[Event]:
        return self.monitor.advance(ns(seconds))

    def reset(self, seconds: float, rule: int | None = None) -> list[Event]:
        return self.monitor.reset(ns(seconds), rule)

    def wake(self) -> float | None:
        wake_ns = self.monitor.next_wake()
        return None if wake_ns is None else wake_ns / SECOND

    def truth(self, index: int) -> TruthValue | None:
        return self.monitor._memory.truths[index]

    def signal(self, index: int) -> float:
        return self.monitor._memory.signals[index]


def ns(seconds: float) -> int:
    return round(seconds * SECOND)


def told(events: Sequence[Event]) -> list[tuple[int, float, Change]]:
    """Rule, instant in seconds and change of the verdicts."""
    return [
        (event.rule, event.at_ns / SECOND, event.change)
        for event in events
        if isinstance(event, Verdict)
    ]


def result_of(function: Function, *values: float) -> float:
    """A function of numbers that arrive in messages."""
    draft = Draft()
    operands = [draft.read() for _ in values]
    result = draft.apply(function, *operands)
    bench = Bench(draft)
    bench.send(0, **{f"c{index}": value for index, value in enumerate(values)})
    return bench.signal(result)


# --- truth and logic -------------------------------------------------------------------------


def test_s1_the_four_values_have_their_numbers():
    assert [value.name for value in sorted(TruthValue)] == ["FALSE", "TRUE", "UNKNOWN", "LOST"]
    assert list(map(int, (F, T, U, L))) == [0, 1, 2, 3]


def test_s2_not():
    assert list(map(negation, (F, T, U, L))) == [T, F, U, L]


def test_s2_and():
    table = [[conjunction((a, b)) for b in (F, T, U, L)] for a in (F, T, U, L)]
    assert table == [[F, F, F, F], [F, T, U, L], [F, U, U, L], [F, L, L, L]]


def test_s2_or():
    table = [[disjunction((a, b)) for b in (F, T, U, L)] for a in (F, T, U, L)]
    assert table == [[F, T, U, L], [T, T, T, T], [U, T, U, L], [L, T, L, L]]


# --- numbers ---------------------------------------------------------------------------------


def test_s3_every_operation_is_rounded_on_its_own():
    # With a fused multiply-add the sum would keep the 2**-60 that the product loses.
    draft = Draft()
    x, y, z = (draft.read() for _ in range(3))
    total = draft.apply(Function.ADD, draft.apply(Function.MULTIPLY, x, y), z)
    bench = Bench(draft)
    bench.send(0, c0=1 + 2.0**-30, c1=1 + 2.0**-30, c2=-(1 + 2.0**-29))
    assert bench.signal(total) == 0.0


@pytest.mark.parametrize(
    ("function", "operands"),
    [
        (Function.ADD, (1.7e308, 1.7e308)),
        (Function.MULTIPLY, (1e200, -1e200)),
        (Function.DIVIDE, (1.0, 0.0)),
        (Function.DIVIDE, (0.0, 0.0)),
        (Function.DIVIDE, (1e308, 1e-308)),
        (Function.NORM, (1e200, 0.0)),
    ],
)
def test_s4_results_that_are_not_finite_are_unknown(function, operands):
    assert math.isnan(result_of(function, *operands))


def test_s5_norm():
    assert result_of(Function.NORM, 2.0, 3.0, 6.0) == 7.0
    assert result_of(Function.NORM, -2.0) == 2.0


@pytest.mark.parametrize("length", [1.0, 0.01, 700.0])
@pytest.mark.parametrize("angles", [(0.5, 0.0, 0.0), (0.1, -0.7, 2.5), (-3.0, 1.5, -0.3)])
def test_s5_angles_of_an_orientation_of_any_length(length, angles):
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(a / 2), math.cos(a / 2)) for a in angles)
    orientation = (  # yaw about z, then pitch about y, then roll about x (REP 103)
        length * (sr * cp * cy - cr * sp * sy),
        length * (cr * sp * cy + sr * cp * sy),
        length * (cr * cp * sy - sr * sp * cy),
        length * (cr * cp * cy + sr * sp * sy),
    )
    functions = (Function.ROLL, Function.PITCH, Function.YAW)
    found = tuple(result_of(function, *orientation) for function in functions)
    assert found == pytest.approx(angles)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_s5_a_sine_beyond_one_is_cut(sign):
    x, y = UPRIGHT
    assert (2.0 * (y * y + x * x)) / (((x * x + y * y) + x * x) + y * y) > 1.0
    pitch = result_of(Function.PITCH, x, sign * y, -sign * x, y)
    assert pitch == sign * math.pi / 2


def test_s5_an_orientation_of_zeros_is_unknown():
    for function in (Function.ROLL, Function.PITCH, Function.YAW):
        assert math.isnan(result_of(function, 0.0, 0.0, 0.0, 0.0))


def test_s6_minimum_and_maximum():
    assert result_of(Function.MINIMUM, 1.0, 2.0) == 1.0
    assert result_of(Function.MAXIMUM, 1.0, 2.0) == 2.0
    assert math.isnan(result_of(Function.MINIMUM, NAN, 1.0))
    assert math.isnan(result_of(Function.MAXIMUM, 1.0, NAN))
    # Of equal ones it is the second, which shows in the sign of zero.
    assert math.copysign(1.0, result_of(Function.MINIMUM, 0.0, -0.0)) == -1.0
    assert math.copysign(1.0, result_of(Function.MAXIMUM, -0.0, 0.0)) == 1.0
    assert math.copysign(1.0, result_of(Function.ABSOLUTE, -0.0)) == 1.0


# --- inputs ----------------------------------------------------------------------------------


def test_s7_numbers_are_converted_on_arrival():
    draft = Draft()
    used = draft.input(draft.channel())
    celsius = draft.signal(Read(draft.slot(used, scale=1.0, offset=273.15)))
    degrees = draft.signal(Read(draft.slot(used, scale=math.pi / 180)))
    plain = draft.signal(Read(draft.slot(used)))
    bench = Bench(draft)
    bench.send(0, c0=20.0)
    assert bench.signal(celsius) == 293.15
    assert bench.signal(degrees) == 20.0 * (math.pi / 180)
    bench.send(1, c0=INFINITY)
    assert math.isnan(bench.signal(celsius))
    assert math.isnan(bench.signal(plain))
    bench.send(2, c0=-0.0)  # adding an offset of 0.0 would lose the sign
    assert math.copysign(1.0, bench.signal(plain)) == -1.0


def test_s7_a_slot_that_is_left_out_is_unknown():
    draft = Draft()
    x = draft.read()
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    bench.monitor.update(SECOND, {0: ChannelValues()})
    assert math.isnan(bench.signal(x))


def test_s8_infinite_elements_are_ordinary_numbers():
    draft = Draft()
    element = draft.elements()
    least = draft.signal(Fold(Folding.MINIMUM, element))
    previous = draft.signal(Previous(least))
    doubled = draft.apply(Function.ADD, least, least)
    far = draft.above(least, 10.0)
    was_far = draft.above(previous, 10.0)
    doubled_far = draft.above(doubled, 10.0)
    bench = Bench(draft)
    bench.send(0, c0=[INFINITY, INFINITY])
    bench.send(1, c0=[INFINITY])
    assert (bench.truth(far), bench.truth(was_far)) == (T, T)
    assert bench.truth(doubled_far) is U


def test_s9_a_message_makes_all_inputs_of_its_channel_fresh():
    draft = Draft()
    channel = draft.channel()
    short, long = draft.input(channel, SECOND), draft.input(channel, 2 * SECOND)
    x, y = (draft.signal(Read(draft.slot(used))) for used in (short, long))
    both = draft.truth(And((draft.above(x, 0.0), draft.above(y, 0.0))))
    draft.rule(both)
    bench = Bench(draft)
    (verdict,) = bench.send(0, c0=NAN)  # what it brings does not matter
    assert verdict.inputs == (InputState.FRESH, InputState.FRESH)
    assert bench.wake() == 1.0
    bench.advance(1)
    assert bench.wake() == 2.0


def test_s10_an_input_expires_when_its_age_reaches_the_timeout():
    draft = Draft()
    x = draft.read(timeout_ns=SECOND)
    forever = draft.read()
    bench = Bench(draft)
    bench.send(0, c0=5.0, c1=6.0)
    bench.monitor.advance(SECOND - 1)
    assert bench.signal(x) == 5.0
    bench.monitor.advance(SECOND)
    assert math.isnan(bench.signal(x))
    bench.send(1e6, c0=7.0)
    assert bench.signal(forever) == 6.0


def test_s10_a_message_at_the_instant_of_expiry_is_in_time():
    draft = Draft()
    x = draft.read(timeout_ns=SECOND)
    draft.rule(draft.above(x, 10.0))
    bench = Bench(draft)
    assert [*bench.send(0, c0=5.0), *bench.send(1, c0=6.0), *bench.send(2, c0=6.0)] == []


# --- time and events -------------------------------------------------------------------------


def test_s11_messages_of_one_update_are_seen_together():
    draft = Draft()
    x, y = draft.read(), draft.read()
    draft.rule(draft.truth(Compare(Comparison.GREATER, x, y)))
    bench = Bench(draft)
    assert bench.send(0, c0=1.0, c1=2.0) == []
    assert bench.send(1, c0=3.0, c1=4.0) == []  # one by one, 3 > 2 would show


def test_s12_nothing_happens_before_the_first_event():
    draft = Draft()
    draft.rule(draft.above(draft.read(timeout_ns=SECOND), 0.0))
    bench = Bench(draft)
    assert bench.monitor.active == (False,)
    assert bench.wake() is None


@pytest.mark.parametrize("first", ["update", "advance", "reset"])
def test_s12_guarded_rules_are_active_until_their_input_arrives(first):
    draft = Draft()
    guarded, other = draft.read(timeout_ns=SECOND), draft.read()
    draft.rule(draft.above(guarded, 0.0))
    draft.rule(draft.above(other, 0.0))
    draft.channel()
    bench = Bench(draft)
    step = {"update": lambda: bench.send(0, c2=0.0), "advance": lambda: bench.advance(0)}
    events = step.get(first, lambda: bench.reset(0))()
    assert told(events) == [(0, 0.0, Change.ACTIVATED_LOST)]
    assert told(bench.send(0.5, c0=-1.0)) == [(0, 0.5, Change.CLEARED)]


def test_s13_wakes_before_an_event_are_run_at_their_own_instants():
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    early = draft.truth(Held(positive, 2 * SECOND))
    late = draft.truth(Held(early, SECOND))
    for truth in (early, late):
        draft.rule(truth)
    bench = Bench(draft)
    assert bench.send(0, c0=1.0) == []
    assert told(bench.send(10, c0=-1.0)) == [
        (0, 2.0, Change.ACTIVATED),
        (1, 3.0, Change.ACTIVATED),
        (0, 10.0, Change.CLEARED),
        (1, 10.0, Change.CLEARED),
    ]


def test_s14_an_update_and_a_wake_at_one_instant_are_one_evaluation():
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    draft.rule(draft.truth(Held(positive, 2 * SECOND)))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    assert bench.send(2, c0=-1.0) == []


def test_s14_advance_includes_its_instant():
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    draft.rule(draft.truth(Held(positive, 2 * SECOND)))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    assert bench.monitor.advance(2 * SECOND - 1) == []
    assert told(bench.advance(2)) == [(0, 2.0, Change.ACTIVATED)]


def test_s15_the_next_wake_is_the_earliest_timer():
    draft = Draft()
    x = draft.read(timeout_ns=9 * SECOND)
    positive = draft.above(x, 0.0)
    draft.truth(Held(positive, 3 * SECOND))
    draft.truth(AgeReaches(0, 5 * SECOND))
    draft.truth(Oscillates(x, 1, 7 * SECOND, 0.0))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    bench.send(0, c0=2.0)
    bench.send(0, c0=1.0)
    wakes = []
    while (wake := bench.wake()) is not None:
        wakes.append(wake)
        bench.advance(wake)
    assert wakes == [3.0, 5.0, 7.0, 9.0]


@settings(max_examples=60, deadline=None)
@given(cases())
def test_s15_a_wake_lies_ahead(case):
    machine, trace = case
    monitor = Interpreter(machine)
    for step in trace:
        take(monitor, step)
        wake_ns = monitor.next_wake()
        assert wake_ns is None or wake_ns > step.at_ns


@settings(max_examples=60, deadline=None)
@given(cases())
def test_s15_waking_in_between_changes_nothing(case):
    """Whoever obeys the wakes, and even looks in between, sees the same as who does not."""
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


def test_s16_updates_at_one_instant_are_evaluated_one_by_one():
    draft = Draft()
    draft.rule(draft.above(draft.read(), 0.0))
    bench = Bench(draft)
    events = [event for x in (1.0, -1.0, 1.0) for event in bench.send(4, c0=x)]
    assert told(events) == [
        (0, 4.0, Change.ACTIVATED),
        (0, 4.0, Change.CLEARED),
        (0, 4.0, Change.ACTIVATED),
    ]


def test_s17_a_jump_is_reported_and_restarts_durations():
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    draft.rule(draft.truth(Held(positive, 2 * SECOND)))
    bench = Bench(draft)
    bench.send(10, c0=1.0)
    bench.advance(13)
    events = bench.send(5, c0=1.0)
    assert events[0] == TimeJump(13 * SECOND, 5 * SECOND)
    assert told(events) == [(0, 5.0, Change.CLEARED)]
    assert events[1].since_ns == (5 * SECOND, 5 * SECOND)
    assert told(bench.advance(20)) == [(0, 7.0, Change.ACTIVATED)]


def test_s17_fresh_inputs_count_as_received_at_the_jump():
    draft = Draft()
    x = draft.read(timeout_ns=SECOND)
    old = draft.truth(AgeReaches(0, SECOND // 2))
    bench = Bench(draft)
    bench.send(10, c0=1.0)
    bench.advance(10.75)
    assert bench.truth(old) is T
    bench.advance(3)
    assert bench.truth(old) is F
    assert bench.signal(x) == 1.0
    assert bench.wake() == 3.5
    bench.advance(3.5)
    assert bench.wake() == 4.0


def test_s17_expired_inputs_stay_expired():
    draft = Draft()
    x = draft.read(timeout_ns=SECOND)
    old = draft.truth(AgeReaches(0, SECOND))
    older = draft.truth(AgeReaches(0, 3 * SECOND))
    draft.read(timeout_ns=SECOND)
    draft.rule(draft.above(x, 0.0))
    draft.rule(draft.above(x + 1, 0.0))
    bench = Bench(draft)
    bench.send(10, c0=1.0)
    bench.advance(20)
    assert bench.truth(older) is T
    bench.advance(4)
    assert math.isnan(bench.signal(x))
    assert (bench.truth(old), bench.truth(older)) == (T, F)
    assert bench.wake() == 6.0  # expired at 4, so its message counts as sent at 3
    bench.advance(6)
    assert bench.truth(older) is T


def test_s17_samples_are_forgotten():
    draft = Draft()
    x = draft.read()
    rate, previous = draft.signal(Rate(x)), draft.signal(Previous(x))
    shaking = draft.truth(Oscillates(x, 1, 100 * SECOND, 0.0))
    bench = Bench(draft)
    for second, value in enumerate((1.0, 2.0, 1.0)):
        bench.send(second, c0=value)
    assert (bench.signal(rate), bench.signal(previous), bench.truth(shaking)) == (-1.0, 2.0, T)
    bench.send(0, c0=3.0)
    assert math.isnan(bench.signal(rate))
    assert math.isnan(bench.signal(previous))
    assert bench.truth(shaking) is F


def test_s17_after_a_jump_the_next_message_is_the_first_sample():
    draft = Draft()
    shaking = draft.truth(Oscillates(draft.read(), 1, 100 * SECOND, 0.0))
    bench = Bench(draft)
    bench.send(10, c0=5.0)
    bench.advance(0)
    bench.send(1, c0=1.0)  # would be on its way down from 5
    bench.send(2, c0=2.0)
    assert bench.truth(shaking) is F
    bench.send(3, c0=1.0)
    assert bench.truth(shaking) is T


def test_s17_rules_keep_their_state_until_evaluated():
    draft = Draft()
    draft.rule(draft.above(draft.read(), 0.0))
    bench = Bench(draft)
    bench.send(10, c0=1.0)
    assert told(bench.advance(5)) == []
    assert bench.monitor.active == (True,)


# --- signals with a memory -------------------------------------------------------------------


def test_s18_a_sample_is_taken_when_a_channel_of_the_signal_is_updated():
    draft = Draft()
    total = draft.apply(Function.ADD, draft.read(), draft.read())
    draft.read()
    rate = draft.signal(Rate(total))
    bench = Bench(draft)
    bench.send(0, c0=1.0, c1=1.0)
    bench.send(1, c1=2.0)
    assert bench.signal(rate) == 1.0
    bench.send(5, c2=0.0)  # a channel that it does not rest on
    assert bench.signal(rate) == 1.0
    bench.send(6, c0=1.0)  # the same value again is a sample
    assert bench.signal(rate) == 0.0


def test_s18_a_sample_at_an_equal_instant_replaces_the_last():
    draft = Draft()
    x = draft.read()
    rate, previous = draft.signal(Rate(x)), draft.signal(Previous(x))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    bench.send(1, c0=100.0)
    bench.send(1, c0=3.0)
    assert (bench.signal(rate), bench.signal(previous)) == (2.0, 1.0)


def test_s19_rate_is_the_slope_of_the_last_two_samples():
    draft = Draft()
    rate = draft.signal(Rate(draft.read()))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    assert math.isnan(bench.signal(rate))
    bench.monitor.update(3, {0: ChannelValues(slots={0: 1.1})})
    assert bench.signal(rate) == (1.1 - 1.0) / (3.0 / 1e9)


def test_s19_rate_is_unknown_unless_both_samples_are_finite():
    draft = Draft()
    rate = draft.signal(Rate(draft.read()))
    bench = Bench(draft)
    seen = []
    for second, value in enumerate((1.0, NAN, 2.0, 3.0, 1.7e308, -1.7e308)):
        bench.send(second, c0=value)
        seen.append(bench.signal(rate))
    assert [math.isnan(value) for value in seen] == [True, True, True, False, False, True]


def test_s20_previous_is_the_sample_before_the_last():
    draft = Draft()
    previous = draft.signal(Previous(draft.read()))
    bench = Bench(draft)
    seen = []
    for second, value in enumerate((1.0, 2.0, NAN, 4.0)):
        bench.send(second, c0=value)
        seen.append(bench.signal(previous))
    assert math.isnan(seen[0])
    assert seen[1:3] == [1.0, 2.0]
    assert math.isnan(seen[3])


def test_s21_samples_are_forgotten_when_an_input_expires():
    draft = Draft()
    x = draft.read(timeout_ns=SECOND)
    rate, previous = draft.signal(Rate(x)), draft.signal(Previous(x))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    bench.send(0.5, c0=2.0)
    bench.advance(2)
    assert math.isnan(bench.signal(rate))
    assert math.isnan(bench.signal(previous))
    bench.send(3, c0=3.0)
    assert math.isnan(bench.signal(rate))
    assert math.isnan(bench.signal(previous))
    bench.send(3.5, c0=4.0)
    assert bench.signal(rate) == 2.0


# --- arrays ----------------------------------------------------------------------------------


def test_s22_functions_apply_to_each_element():
    draft = Draft()
    element = draft.elements()
    off = draft.apply(Function.SUBTRACT, element, draft.constant(3.0))
    distance = draft.apply(Function.ABSOLUTE, off)
    least = draft.signal(Fold(Folding.MINIMUM, distance))
    near, far = draft.above(distance, 1.5), draft.above(element, 3.5)
    both = draft.truth(And((near, draft.truth(Not(far)))))
    count = draft.signal(Count(both))
    bench = Bench(draft)
    bench.send(0, c0=[1.0, 2.5, 5.0])
    assert bench.signal(least) == 0.5
    assert bench.signal(count) == 1.0
    bench.send(1, c0=[1.0, INFINITY])  # abs(inf - 3) is no finite result
    assert math.isnan(bench.signal(least))


def test_s23_least_and_greatest_element():
    draft = Draft()
    element = draft.elements()
    least, greatest = (draft.signal(Fold(folding, element)) for folding in Folding)
    bench = Bench(draft)
    bench.send(0, c0=[3.0, -1.0, 2.0])
    assert (bench.signal(least), bench.signal(greatest)) == (-1.0, 3.0)
    bench.send(1, c0=[0.0, -0.0])
    assert math.copysign(1.0, bench.signal(least)) == -1.0
    bench.send(2, c0=[])
    assert math.isnan(bench.signal(least))


def test_s23_a_nan_element_makes_them_unknown():
    draft = Draft()
    least = draft.signal(Fold(Folding.MINIMUM, draft.elements()))
    bench = Bench(draft)
    for elements in ([NAN, 1.0], [1.0, NAN], [1.0, NAN, 2.0]):
        bench.send(0, c0=elements)
        assert math.isnan(bench.signal(least))


def test_s24_count():
    draft = Draft()
    count = draft.signal(Count(draft.above(draft.elements(), 0.0)))
    bench = Bench(draft)
    seen = []
    for elements in ([1.0, -1.0, 2.0], [-1.0], [1.0, NAN], []):
        bench.send(0, c0=elements)
        seen.append(bench.signal(count))
    assert seen[:2] == [2.0, 0.0]
    assert all(map(math.isnan, seen[2:]))


@pytest.mark.parametrize(
    ("elements", "some", "every"),
    [
        ([1.0, 2.0], T, T),
        ([1.0, -1.0], T, F),
        ([-1.0, -1.0], F, F),
        ([1.0, NAN], T, U),
        ([-1.0, NAN], U, F),
        ([], U, U),
    ],
)
def test_s25_any_and_all(elements, some, every):
    draft = Draft()
    positive = draft.above(draft.elements(), 0.0)
    some_truth, every_truth = (draft.truth(Quantified(which, positive)) for which in Quantifier)
    bench = Bench(draft)
    bench.send(0, c0=elements)
    assert (bench.truth(some_truth), bench.truth(every_truth)) == (some, every)


def test_s26_results_hold_until_the_next_message_or_expiry():
    draft = Draft()
    least = draft.signal(Fold(Folding.MINIMUM, draft.elements(timeout_ns=SECOND)))
    draft.read()
    bench = Bench(draft)
    bench.send(0, c0=[4.0, 5.0])
    bench.send(0.5, c1=0.0)
    assert bench.signal(least) == 4.0
    bench.advance(1)
    assert math.isnan(bench.signal(least))


# --- conditions ------------------------------------------------------------------------------


def test_s27_comparisons():
    draft = Draft()
    x, y = draft.read(), draft.read()
    truths = [draft.truth(Compare(comparison, x, y)) for comparison in Comparison]
    bench = Bench(draft)

    def of(a: float, b: float) -> list[TruthValue | None]:
        bench.send(0, c0=a, c1=b)
        return [bench.truth(truth) for truth in truths]

    assert of(1.0, 2.0) == [F, T, T, T, F, F]
    assert of(2.0, 1.0) == [F, T, F, F, T, T]
    assert of(0.0, -0.0) == [T, F, F, T, F, T]
    assert of(NAN, 1.0) == of(1.0, NAN) == of(NAN, NAN) == [U] * 6


def test_s28_ranges_include_both_ends():
    draft = Draft()
    x = draft.read()
    inside = draft.truth(Between(x, draft.constant(-1.0), draft.constant(1.0)))
    bench = Bench(draft)
    seen = []
    for value in (-1.5, -1.0, 0.0, 1.0, 1.5, NAN):
        bench.send(0, c0=value)
        seen.append(bench.truth(inside))
    assert seen == [F, T, T, T, F, U]


def test_s29_flags_and_texts():
    draft = Draft(texts=("docked", "driving"))
    flag = draft.truth(Flag(draft.read(kind=Kind.FLAG)))
    mode = draft.read(kind=Kind.TEXT)
    docked = draft.truth(Compare(Comparison.EQUAL, mode, draft.constant(0.0)))
    other = draft.truth(Compare(Comparison.NOT_EQUAL, mode, draft.constant(0.0)))
    bench = Bench(draft)
    bench.advance(0)
    assert [bench.truth(truth) for truth in (flag, docked, other)] == [U, U, U]
    bench.send(0, c0=1.0, c1=0.0)
    assert [bench.truth(truth) for truth in (flag, docked, other)] == [T, T, F]
    bench.send(0, c0=0.0, c1=-1.0)
    assert [bench.truth(truth) for truth in (flag, docked, other)] == [F, F, T]


def test_s30_lost_means_for_lack_of_an_input_with_a_timeout():
    draft = Draft()
    guarded, other = draft.read(timeout_ns=SECOND), draft.read()
    both = draft.truth(Compare(Comparison.GREATER, guarded, other))
    bench = Bench(draft)
    bench.advance(0)
    assert bench.truth(both) is L
    bench.send(0, c0=1.0)
    assert bench.truth(both) is U
    bench.send(0.5, c1=0.0)
    assert bench.truth(both) is T
    bench.advance(1)
    assert bench.truth(both) is L


def test_s30_nan_from_a_guarded_input_is_lost():
    draft = Draft()
    positive = draft.above(draft.read(timeout_ns=SECOND), 0.0)
    bench = Bench(draft)
    bench.send(0, c0=NAN)
    assert bench.truth(positive) is L


def test_s30_waiting_for_a_second_sample_is_not_lost():
    draft = Draft()
    rate = draft.signal(Rate(draft.read(timeout_ns=SECOND)))
    rising = draft.above(rate, 0.0)
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    assert bench.truth(rising) is U
    bench.advance(1)
    assert bench.truth(rising) is L


def test_s30_arrays_of_guarded_inputs():
    draft = Draft()
    element = draft.elements(timeout_ns=SECOND)
    least = draft.signal(Fold(Folding.MINIMUM, element))
    count = draft.signal(Count(draft.above(element, 0.0)))
    some = draft.truth(Quantified(Quantifier.ANY, draft.above(element, 5.0)))
    truths = [some, draft.above(least, 0.0), draft.above(count, 0.0)]
    waiting = draft.above(draft.signal(Rate(least)), 0.0)
    bench = Bench(draft)
    for elements in ([], [NAN]):
        bench.send(0, c0=elements)
        assert [bench.truth(truth) for truth in truths] == [L, L, L]
    bench.send(0.5, c0=[1.0])
    assert [bench.truth(truth) for truth in truths] == [F, T, T]
    assert bench.truth(waiting) is U


def test_s31_age_grows_on_after_expiry():
    draft = Draft()
    draft.read(timeout_ns=SECOND)
    old = draft.truth(AgeReaches(0, 3 * SECOND))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    bench.monitor.advance(3 * SECOND - 1)
    assert bench.truth(old) is F
    bench.advance(3)
    assert bench.truth(old) is T
    bench.send(4, c0=NAN)
    assert bench.truth(old) is F


def test_s31_age_is_unknown_before_the_first_message():
    draft = Draft()
    draft.read(timeout_ns=SECOND)
    draft.read()
    guarded, other = (draft.truth(AgeReaches(used, SECOND)) for used in (0, 1))
    bench = Bench(draft)
    bench.advance(0)
    assert (bench.truth(guarded), bench.truth(other)) == (L, U)


def shaken(values: Sequence[float], count: int, swing: float) -> list[TruthValue | None]:
    draft = Draft()
    truth = draft.truth(Oscillates(draft.read(), count, 100 * SECOND, swing))
    bench = Bench(draft)
    seen = []
    for second, value in enumerate(values):
        bench.send(second, c0=value)
        seen.append(bench.truth(truth))
    return seen


def test_s32_turning_points():
    #         start up   up   turn  down  turn  turn
    values = (0.0, 1.0, 2.0, 1.0, 0.5, 3.0, 2.0)
    assert shaken(values, 1, 0.0) == [F, F, F, T, T, T, T]
    assert shaken(values, 3, 0.0) == [F, F, F, F, F, F, T]


def test_s32_small_swings_do_not_count():
    # Neither do swings of just the given size: they have to be larger.
    assert shaken((0.0, 5.0, 4.0, 5.0, 4.0), 1, 1.0) == [F] * 5
    assert shaken((0.0, -5.0, -4.0, -5.0, -4.0), 1, 1.0) == [F] * 5
    assert shaken((0.0, 1.0, 0.0, 0.5, -0.5), 1, 1.0) == [F] * 5
    assert shaken((0.0, 0.5, -0.5, 5.0, 3.0), 1, 1.0) == [F, F, F, F, T]


def test_s32_the_window_closes():
    draft = Draft()
    truth = draft.truth(Oscillates(draft.read(), 2, 2 * SECOND, 0.0))
    bench = Bench(draft)
    for second, value in ((0, 0.0), (1, 1.0), (2, 0.0), (3, 1.0)):
        bench.send(second, c0=value)
    assert bench.truth(truth) is T
    assert bench.wake() == 4.0  # the turning points were at 2 and 3
    bench.advance(4)
    assert bench.truth(truth) is F
    assert bench.wake() is None


def test_s32_unknown_forgets_turning_points():
    assert shaken((0.0, 1.0, 0.0, NAN, 1.0, 0.0, 1.0), 1, 0.0) == [F, F, T, U, F, F, T]


def test_s33_for_matures_at_its_own_instant():
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    held = draft.truth(Held(positive, 2 * SECOND))
    bench = Bench(draft)
    bench.send(0, c0=-1.0)
    assert bench.truth(held) is F
    bench.send(1, c0=1.0)
    bench.send(2, c0=5.0)
    assert bench.truth(held) is F
    bench.advance(3)
    assert bench.truth(held) is T
    bench.send(4, c0=-1.0)
    assert bench.truth(held) is F


def test_s33_unknown_breaks_it():
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    held = draft.truth(Held(positive, 2 * SECOND))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    bench.send(1, c0=NAN)
    assert bench.truth(held) is U
    bench.send(1.5, c0=1.0)
    bench.advance(3)
    assert bench.truth(held) is F
    bench.advance(3.5)
    assert bench.truth(held) is T


def test_s33_nothing_has_held_before_the_start():
    draft = Draft()
    always = draft.truth(Literal(True))
    held = draft.truth(Held(always, SECOND))
    bench = Bench(draft)
    bench.advance(100)
    assert bench.truth(held) is F
    bench.advance(101)
    assert bench.truth(held) is T


def test_s33_nested():
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    inner = draft.truth(Held(positive, SECOND))
    calm = draft.truth(Held(draft.truth(Not(inner)), 2 * SECOND))
    bench = Bench(draft)
    bench.send(0, c0=-1.0)
    bench.advance(2)
    assert bench.truth(calm) is T
    bench.send(3, c0=1.0)
    assert bench.truth(calm) is T
    bench.advance(4)
    assert bench.truth(calm) is F


def test_s34_since_when():
    draft = Draft()
    positive = draft.above(draft.read(timeout_ns=SECOND), 0.0)
    draft.rule(draft.truth(Or((positive, draft.truth(Not(positive))))))
    bench = Bench(draft)

    def since() -> float:
        return bench.monitor._memory.since_ns[positive] / SECOND

    seen = []
    for second, value in ((1, 2.0), (1.5, 3.0), (2, -1.0), (2.5, -2.0)):
        bench.send(second, c0=value)
        seen.append(since())
    bench.advance(9)
    assert [*seen, since()] == [1.0, 1.0, 2.0, 2.0, 3.5]


# --- rules -----------------------------------------------------------------------------------


def test_s35_true_activates():
    draft = Draft()
    draft.rule(draft.above(draft.read(), 0.0))
    bench = Bench(draft)
    assert told(bench.send(0, c0=-1.0)) == []
    assert told(bench.send(1, c0=1.0)) == [(0, 1.0, Change.ACTIVATED)]
    assert told(bench.send(2, c0=2.0)) == []
    assert bench.monitor.active == (True,)


def test_s35_lost_activates():
    draft = Draft()
    draft.rule(draft.above(draft.read(timeout_ns=SECOND), 0.0))
    bench = Bench(draft)
    assert told(bench.send(0, c0=-1.0)) == []
    assert told(bench.advance(2)) == [(0, 1.0, Change.ACTIVATED_LOST)]
    assert told(bench.send(3, c0=1.0)) == []


def test_s36_without_a_contract_false_clears():
    draft = Draft()
    draft.rule(draft.above(draft.read(), 0.0))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    assert told(bench.send(1, c0=-1.0)) == [(0, 1.0, Change.CLEARED)]
    assert bench.monitor.active == (False,)


def test_s36_clear_when():
    draft = Draft()
    x, y = draft.read(), draft.read()
    draft.rule(draft.above(x, 0.0), draft.above(y, 0.0))
    bench = Bench(draft)
    bench.send(0, c0=1.0, c1=1.0)  # a true release alone does not clear
    assert bench.monitor.active == (True,)
    assert told(bench.send(1, c0=-1.0, c1=-1.0)) == []
    assert told(bench.send(2, c1=1.0)) == [(0, 2.0, Change.CLEARED)]


def test_s36_clear_for():
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    draft.rule(positive, draft.truth(Held(draft.truth(Not(positive)), 2 * SECOND)))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    bench.send(1, c0=-1.0)
    bench.send(2, c0=1.0)
    bench.send(3, c0=-1.0)
    assert told(bench.advance(9)) == [(0, 5.0, Change.CLEARED)]


def test_s37_unknown_neither_activates_nor_clears():
    draft = Draft()
    draft.rule(draft.above(draft.read(), 0.0))
    bench = Bench(draft)
    assert bench.send(0, c0=NAN) == []
    bench.send(1, c0=1.0)
    assert bench.send(2, c0=NAN) == []
    assert bench.monitor.active == (True,)


def test_s38_a_reset_clears_while_the_condition_is_false():
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    draft.rule(positive, latched=True)
    draft.rule(positive, draft.truth(Literal(False)))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    assert bench.send(1, c0=-1.0) == []
    assert told(bench.reset(2)) == [(0, 2.0, Change.CLEARED)]
    assert bench.monitor.active == (False, True)


def test_s38_a_reset_has_no_later_effect():
    draft = Draft()
    draft.rule(draft.above(draft.read(), 0.0), latched=True)
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    assert bench.reset(1) == []
    assert bench.send(2, c0=-1.0) == []
    assert bench.monitor.active == (True,)
    bench.send(3, c0=NAN)
    assert bench.reset(3) == []


def test_s38_a_reset_of_one_rule():
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    for _ in range(2):
        draft.rule(positive, latched=True)
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    bench.send(1, c0=-1.0)
    assert told(bench.reset(2, rule=1)) == [(1, 2.0, Change.CLEARED)]
    assert told(bench.reset(2, rule=1)) == []


@settings(max_examples=60, deadline=None)
@given(cases())
def test_s39_a_rule_changes_once_in_an_evaluation(case):
    machine, trace = case
    monitor = Interpreter(machine)
    for step in trace:
        if isinstance(step, Update):
            monitor.advance(step.at_ns)
        changes = [event.rule for event in take(monitor, step) if isinstance(event, Verdict)]
        if isinstance(step, Update):
            assert len(changes) == len(set(changes))


def test_s40_verdicts_come_in_the_order_of_the_rules():
    draft = Draft()
    positive = draft.above(draft.read(), 0.0)
    draft.rule(draft.truth(Not(positive)))
    draft.rule(positive)
    draft.rule(positive)
    bench = Bench(draft)
    bench.send(0, c0=-1.0)
    assert told(bench.send(1, c0=1.0)) == [
        (0, 1.0, Change.CLEARED),
        (1, 1.0, Change.ACTIVATED),
        (2, 1.0, Change.ACTIVATED),
    ]


def test_s41_a_verdict_carries_a_snapshot():
    draft = Draft()
    x = draft.read(timeout_ns=9 * SECOND)
    y = draft.read()
    positive, large = draft.above(x, 0.0), draft.above(y, 5.0)
    draft.rule(draft.truth(Held(draft.truth(Or((positive, large))), 2 * SECOND)))
    bench = Bench(draft)
    bench.send(0, c0=-1.0)
    bench.send(1, c0=1.5)
    (verdict,) = bench.advance(5)
    assert verdict == Verdict(
        rule=0,
        at_ns=3 * SECOND,
        change=Change.ACTIVATED,
        truths=(T, U, T),
        since_ns=(SECOND, 0, 3 * SECOND),
        values=(1.5, verdict.values[1]),
        inputs=(InputState.FRESH, InputState.NEVER),
    )
    assert math.isnan(verdict.values[1])


@settings(max_examples=30, deadline=None)
@given(cases())
def test_a_monitor_is_deterministic(case):
    machine, trace = case
    assert observe(Interpreter(machine), trace) == observe(Interpreter(machine), trace)


@pytest.mark.parametrize("at_ns", [-(2**61), 2**62])
def test_instants_out_of_range_are_refused(at_ns):
    monitor = Interpreter(Draft().machine())
    with pytest.raises(ValueError, match="out of range"):
        monitor.advance(at_ns)
