"""Inputs: rules S7 to S10 of docs/explanation/semantics.md."""

import math

from rossmarie.ir import (
    And,
    ChannelValues,
    Fold,
    Folding,
    Function,
    InputState,
    Read,
    Sampled,
    Sampling,
    TruthValue,
    Verdict,
)
from support.bench import Bench
from support.drafts import SECOND, Draft
from support.machines import INFINITY, NAN

F, T, U, L = TruthValue


def test_s7_numbers_are_converted_on_arrival() -> None:
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


def test_s7_a_slot_that_is_left_out_is_unknown() -> None:
    draft = Draft()
    x = draft.read()
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    bench.monitor.update(SECOND, {0: ChannelValues()})
    assert math.isnan(bench.signal(x))


def test_s8_infinite_elements_are_ordinary_numbers() -> None:
    draft = Draft()
    element = draft.elements()
    least = draft.signal(Fold(Folding.MINIMUM, element))
    previous = draft.signal(Sampled(Sampling.PREVIOUS, least))
    doubled = draft.apply(Function.ADD, least, least)
    far = draft.above(least, 10.0)
    was_far = draft.above(previous, 10.0)
    doubled_far = draft.above(doubled, 10.0)
    bench = Bench(draft)
    bench.send(0, c0=[INFINITY, INFINITY])
    bench.send(1, c0=[INFINITY])
    assert (bench.proposition(far), bench.proposition(was_far)) == (T, T)
    assert bench.proposition(doubled_far) is U


def test_s9_a_message_makes_all_inputs_of_its_channel_fresh() -> None:
    draft = Draft()
    channel = draft.channel()
    short, long = draft.input(channel, SECOND), draft.input(channel, 2 * SECOND)
    x, y = (draft.signal(Read(draft.slot(used))) for used in (short, long))
    both = draft.proposition(And((draft.above(x, 0.0), draft.above(y, 0.0))))
    draft.rule(both)
    bench = Bench(draft)
    (verdict,) = bench.send(0, c0=NAN)  # what it brings does not matter
    assert isinstance(verdict, Verdict)
    assert verdict.inputs == (InputState.FRESH, InputState.FRESH)
    assert bench.wake() == 1.0
    bench.advance(1)
    assert bench.wake() == 2.0


def test_s10_an_input_expires_when_its_age_reaches_the_timeout() -> None:
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


def test_s10_a_message_at_the_instant_of_expiry_is_in_time() -> None:
    draft = Draft()
    x = draft.read(timeout_ns=SECOND)
    draft.rule(draft.above(x, 10.0))
    bench = Bench(draft)
    assert [*bench.send(0, c0=5.0), *bench.send(1, c0=6.0), *bench.send(2, c0=6.0)] == []
