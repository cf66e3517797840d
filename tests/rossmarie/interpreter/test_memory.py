"""Signals with a memory: rules S18 to S21 of docs/explanation/semantics.md."""

import math

from rossmarie.ir import ChannelValues, Function, Sampled, Sampling
from support.bench import Bench
from support.drafts import SECOND, Draft
from support.machines import NAN


def test_s18_a_sample_is_taken_when_a_channel_of_the_signal_is_updated() -> None:
    draft = Draft()
    total = draft.apply(Function.ADD, draft.read(), draft.read())
    draft.read()
    rate = draft.signal(Sampled(Sampling.RATE, total))
    bench = Bench(draft)
    bench.send(0, c0=1.0, c1=1.0)
    bench.send(1, c1=2.0)
    assert bench.signal(rate) == 1.0
    bench.send(5, c2=0.0)  # a channel that it does not rest on
    assert bench.signal(rate) == 1.0
    bench.send(6, c0=1.0)  # the same value again is a sample
    assert bench.signal(rate) == 0.0


def test_s18_a_sample_at_an_equal_instant_replaces_the_last() -> None:
    draft = Draft()
    x = draft.read()
    rate, previous = (
        draft.signal(Sampled(Sampling.RATE, x)),
        draft.signal(Sampled(Sampling.PREVIOUS, x)),
    )
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    bench.send(1, c0=100.0)
    bench.send(1, c0=3.0)
    assert (bench.signal(rate), bench.signal(previous)) == (2.0, 1.0)


def test_s19_rate_is_the_slope_of_the_last_two_samples() -> None:
    draft = Draft()
    rate = draft.signal(Sampled(Sampling.RATE, draft.read()))
    bench = Bench(draft)
    bench.send(0, c0=1.0)
    assert math.isnan(bench.signal(rate))
    bench.monitor.update(3, {0: ChannelValues(slots={0: 1.1})})
    assert bench.signal(rate) == (1.1 - 1.0) / (3.0 / 1e9)


def test_s19_rate_is_unknown_unless_both_samples_are_finite() -> None:
    draft = Draft()
    rate = draft.signal(Sampled(Sampling.RATE, draft.read()))
    bench = Bench(draft)
    seen = []
    for second, value in enumerate((1.0, NAN, 2.0, 3.0, 1.7e308, -1.7e308)):
        bench.send(second, c0=value)
        seen.append(bench.signal(rate))
    assert [math.isnan(value) for value in seen] == [True, True, True, False, False, True]


def test_s20_previous_is_the_sample_before_the_last() -> None:
    draft = Draft()
    previous = draft.signal(Sampled(Sampling.PREVIOUS, draft.read()))
    bench = Bench(draft)
    seen = []
    for second, value in enumerate((1.0, 2.0, NAN, 4.0)):
        bench.send(second, c0=value)
        seen.append(bench.signal(previous))
    assert math.isnan(seen[0])
    assert seen[1:3] == [1.0, 2.0]
    assert math.isnan(seen[3])


def test_s21_samples_are_forgotten_when_an_input_expires() -> None:
    draft = Draft()
    x = draft.read(timeout_ns=SECOND)
    rate, previous = (
        draft.signal(Sampled(Sampling.RATE, x)),
        draft.signal(Sampled(Sampling.PREVIOUS, x)),
    )
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
