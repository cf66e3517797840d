"""Many samples -> few, such that a picture of them looks the same: no spike and no gap is lost.

A value holds until the next time, so samples that repeat the one before them carry nothing.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rossmarie.report.model import Plot

_KEPT = 6
"""Samples that one bucket keeps at most: first, last, least, greatest, first and last unknown."""

Samples = tuple[NDArray[np.float64], NDArray[np.float64]]
"""Times in seconds, ascending, and as many values."""


def envelope(plot: Plot, limit: int) -> Samples:
    """The times and values of a plot, thinned out where there are more than `limit` (>= 6)."""
    times, values = _changes(plot.times_s, plot.values)
    if len(times) <= limit:
        return times, values
    kept = _extremes(times, values, limit // _KEPT)
    return times[kept], values[kept]


def _changes(times: NDArray[np.float64], values: NDArray[np.float64]) -> Samples:
    if len(times) == 0:
        return times, values
    unknown = np.isnan(values)
    repeats = (values[1:] == values[:-1]) | (unknown[1:] & unknown[:-1])
    kept = np.concatenate(([True], ~repeats))
    kept[-1] = True
    return times[kept], values[kept]


def _extremes(
    times: NDArray[np.float64], values: NDArray[np.float64], buckets: int
) -> NDArray[np.intp]:
    """The indexes to keep when the time is cut into equal buckets."""
    place = (times - times[0]) / (times[-1] - times[0]) * buckets
    bucket = np.minimum(place.astype(np.intp), buckets - 1)
    forward = np.arange(len(times))
    unknown = np.flatnonzero(np.isnan(values))
    orders = (
        forward,
        forward[::-1],
        np.argsort(values, kind="stable"),  # unknown values come last
        np.argsort(-values, kind="stable"),
        unknown,
        unknown[::-1],
    )
    firsts = [order[np.unique(bucket[order], return_index=True)[1]] for order in orders]
    return np.unique(np.concatenate(firsts))
