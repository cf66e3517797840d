from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from rossmarie.report.envelope import envelope, share, thinned
from rossmarie.report.model import Plot

steps = st.floats(0.0, 1.0)
levels = st.one_of(st.sampled_from((0.0, 1.0, math.nan)), st.floats(-100, 100))
samples = st.lists(st.tuples(steps, levels), min_size=1, max_size=80)


def plot_of(times: NDArray[np.float64], values: NDArray[np.float64]) -> Plot:
    return Plot("x", "", times, values, ())


def plot_from(found: list[tuple[float, float]]) -> Plot:
    times = np.cumsum([step for step, _ in found])
    return plot_of(times, np.array([value for _, value in found]))


def held(times: NDArray[np.float64], values: NDArray[np.float64], at: float) -> float:
    return float(values[np.searchsorted(times, at, side="right") - 1])


@given(samples)
def test_below_the_limit_the_signal_is_the_same_at_every_instant(
    found: list[tuple[float, float]],
) -> None:
    plot = plot_from(found)
    times, values = envelope(plot, 1000)
    for at in plot.times_s:
        before, after = held(plot.times_s, plot.values, at), held(times, values, at)
        np.testing.assert_array_equal(after, before)  # for which 0 and -0 are the same


@given(samples, st.integers(6, 40))
def test_the_limit_holds_and_only_real_samples_are_kept(
    found: list[tuple[float, float]], limit: int
) -> None:
    plot = plot_from(found)
    times, values = envelope(plot, limit)
    assert len(times) == len(values) <= limit
    real = {(t, repr(v)) for t, v in zip(plot.times_s, plot.values, strict=True)}
    assert {(t, repr(v)) for t, v in zip(times, values, strict=True)} <= real
    assert (np.diff(times) >= 0).all()


@given(samples, st.integers(6, 40))
def test_extremes_and_gaps_are_never_lost(found: list[tuple[float, float]], limit: int) -> None:
    plot = plot_from(found)
    _, values = envelope(plot, limit)
    assert np.isnan(values).any() == np.isnan(plot.values).any()
    if not np.isnan(plot.values).all():
        assert np.nanmax(values) == np.nanmax(plot.values)
        assert np.nanmin(values) == np.nanmin(plot.values)


def test_one_spike_among_many_samples_stays_where_it_was() -> None:
    times = np.arange(50_000) / 30
    values = np.sin(times)
    values[31_415] = 90.0
    kept_times, kept = envelope(plot_of(times, values), 600)
    assert len(kept) <= 600
    assert kept_times[np.argmax(kept)] == times[31_415]


def test_a_gap_keeps_its_beginning_and_where_it_was_last_seen() -> None:
    values = np.sin(np.arange(1000.0))
    values[400] = math.nan
    values[600] = math.nan
    times, kept = envelope(plot_of(np.arange(1000.0), values), 6)
    assert times[np.isnan(kept)].tolist() == [400.0, 600.0]


def test_a_repeated_value_is_stored_once() -> None:
    times, values = envelope(plot_of(np.arange(5.0), np.array([1.0, 1, 1, 2, 2])), 100)
    assert times.tolist() == [0.0, 3.0, 4.0]
    assert values.tolist() == [1.0, 2.0, 2.0]


def test_no_samples_at_all() -> None:
    times, values = envelope(plot_of(np.empty(0), np.empty(0)), 100)
    assert len(times) == len(values) == 0


@given(samples, st.integers(6, 12), st.integers(1, 30))
def test_thinned_in_blocks_extremes_and_gaps_are_never_lost(
    found: list[tuple[float, float]], limit: int, block: int
) -> None:
    plot = plot_from(found)
    times, values = np.empty(0), np.empty(0)
    for start in range(0, len(found), block):
        times = np.concatenate((times, plot.times_s[start : start + block]))
        values = np.concatenate((values, plot.values[start : start + block]))
        times, values = thinned(times, values, limit)
        assert len(times) <= limit
    assert np.isnan(values).any() == np.isnan(plot.values).any()
    if not np.isnan(plot.values).all():
        assert np.nanmax(values) == np.nanmax(plot.values)
        assert np.nanmin(values) == np.nanmin(plot.values)
    assert times[-1] == plot.times_s[-1]


def test_many_samples_of_one_instant_are_thinned() -> None:
    times, values = thinned(np.zeros(100, dtype=np.int64), np.arange(100.0), 12)
    assert times.dtype == np.int64
    assert {0.0, 99.0} <= set(values)


def test_a_share_is_never_too_small_to_thin_to() -> None:
    assert share(1) == 120_000
    assert share(1_000_000) == 6
