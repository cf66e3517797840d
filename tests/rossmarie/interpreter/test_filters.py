"""Filters: rules S49 and S50 of docs/explanation/semantics.md."""

import math

from rossmarie.ir import Sampled, Sampling
from support.bench import Bench
from support.drafts import SECOND, Draft
from support.machines import NAN


def filtered(function: Sampling, time_ns: int, *samples: tuple[float, float]) -> list[float]:
    """A filter of a field behind each of some messages."""
    draft = Draft()
    number = draft.signal(Sampled(function, draft.read(), time_ns))
    bench = Bench(draft)
    found = []
    for at_s, value in samples:
        bench.send(at_s, c0=value)
        found.append(bench.signal(number))
    return found


def test_s49_mean_of_the_window() -> None:
    samples = ((0, 3.0), (1, 1.0), (2, 9.0), (2, 2.0), (12, 7.0))
    assert filtered(Sampling.MEAN, 10 * SECOND, *samples) == [3.0, 2.0, 13.0 / 3.0, 2.0, 7.0]
    assert filtered(Sampling.MEAN, SECOND, (0, 1e16), (0.1, 1.0), (0.2, -1e16))[-1] == 0.0
    found = filtered(Sampling.MEAN, 1000 * SECOND, *((at, float(at)) for at in range(100)))
    assert found[-1] == (36 + 99) / 2


def test_s49_a_sum_that_is_not_finite_is_unknown() -> None:
    found = filtered(
        Sampling.MEAN, 2 * SECOND, (0, 1.7e308), (1, 1.7e308), (5, NAN), (6, 1.0), (9, 2.0)
    )
    assert str(found) == "[1.7e+308, nan, nan, nan, 2.0]"


def test_s50_low_pass_is_backward_euler() -> None:
    first, second, third = filtered(
        Sampling.LOW_PASS, 300_000_000, (1, 4.0), (1.1, 8.0), (1.3, 0.0)
    )
    assert (first, second) == (4.0, 4.0 + (0.1 / (0.3 + 0.1)) * (8.0 - 4.0))
    assert third == second + (0.2 / (0.3 + 0.2)) * (0.0 - second)


def test_s50_a_sample_at_an_equal_instant_replaces_the_last() -> None:
    replaced = filtered(Sampling.LOW_PASS, SECOND, (0, 4.0), (1, NAN), (1, 8.0), (2, 8.0))
    alone = filtered(Sampling.LOW_PASS, SECOND, (0, 4.0), (1, 8.0), (2, 8.0))
    assert [replaced[0], *replaced[2:]] == alone
    assert filtered(Sampling.LOW_PASS, SECOND, (0, 4.0), (0, 8.0)) == [4.0, 8.0]


def test_s50_what_is_not_finite_forgets() -> None:
    found = filtered(Sampling.LOW_PASS, SECOND, (0, 4.0), (1, NAN), (2, 8.0), (3, 0.0))
    assert str(found) == "[4.0, nan, 8.0, 4.0]"
    found = filtered(Sampling.LOW_PASS, SECOND, (0, -1.7e308), (1, 1.7e308), (2, 1.0))
    assert str(found) == "[-1.7e+308, nan, 1.0]"


def test_s50_expiry_and_jumps_forget() -> None:
    draft = Draft()
    x = draft.read(timeout_ns=2 * SECOND)
    smooth = draft.signal(Sampled(Sampling.LOW_PASS, x, SECOND))
    bench = Bench(draft)
    bench.send(0, c0=4.0)
    bench.advance(3)
    assert math.isnan(bench.signal(smooth))
    bench.send(4, c0=8.0)
    assert bench.signal(smooth) == 8.0
    bench.send(5, c0=0.0)
    assert bench.signal(smooth) == 4.0
    bench.send(1, c0=2.0)
    assert bench.signal(smooth) == 2.0


def test_s50_functions_of_filters_sample_with_them() -> None:
    draft = Draft()
    x = draft.read()
    smooth = draft.signal(Sampled(Sampling.LOW_PASS, x, SECOND))
    mean = draft.signal(Sampled(Sampling.MEAN, x, 10 * SECOND))
    slope = draft.signal(Sampled(Sampling.RATE, smooth))
    turn = draft.signal(Sampled(Sampling.RATE, mean))
    before = draft.signal(Sampled(Sampling.PREVIOUS, mean))
    other = draft.signal(Sampled(Sampling.PREVIOUS, x))
    draft.read()  # of a second channel, whose messages bring no sample
    bench = Bench(draft)
    bench.send(0, c0=4.0)
    bench.send(1, c1=1.0)
    assert math.isnan(bench.signal(slope))
    bench.send(2, c0=10.0)
    found = [bench.signal(each) for each in (smooth, mean, slope, turn, before, other)]
    assert found == [8.0, 7.0, 2.0, 1.5, 4.0, 4.0]
