"""Reduces many samples to a few with an equal picture: every spike and every gap remains.

A value is valid until the next time, so repeated samples carry no information.
"""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from rossmarie.report.model import Plot

_KEPT = 6
"""The most samples of one bucket: first, last, least, greatest, first and last unknown."""

_SAMPLES = 120_000
"""The samples in a page, shared evenly among its plots: at 11 bytes each, 1.3 MB."""

_Time = TypeVar("_Time", np.float64, np.int64)


def share(plots: int) -> int:
    """The number of samples of each plot in a page with this number of plots."""
    return max(_SAMPLES // max(plots, 1), _KEPT)


def envelope(plot: Plot, limit: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The times and values of a plot, thinned out if there are more than `limit` (>= 6)."""
    return thinned(plot.times_s, plot.values, limit)


def thinned(
    times: NDArray[_Time], values: NDArray[np.float64], limit: int
) -> tuple[NDArray[_Time], NDArray[np.float64]]:
    """Ascending times and as many values, thinned out if there are more than `limit` (>= 6).

    Thinned samples can be thinned again, together with later samples.
    """
    changes = _changes(values)
    times, values = times[changes], values[changes]
    if len(times) <= limit:
        return times, values
    kept = _extremes(times, values, limit // _KEPT)
    return times[kept], values[kept]


def _changes(values: NDArray[np.float64]) -> NDArray[np.bool_]:
    """A mask of the values that differ from the value before. The last value counts as well."""
    unknown = np.isnan(values)
    repeats = (values[1:] == values[:-1]) | (unknown[1:] & unknown[:-1])
    kept = np.concatenate((np.ones(min(len(values), 1), dtype=bool), ~repeats))
    kept[-1:] = True
    return kept


def _extremes(times: NDArray[_Time], values: NDArray[np.float64], buckets: int) -> NDArray[np.intp]:
    """The indexes of the samples to keep if the time is divided into equal buckets."""
    place = (times - times[0]) / ((times[-1] - times[0]) or 1) * buckets
    bucket = np.minimum(place.astype(np.intp), buckets - 1)
    unknown = np.flatnonzero(np.isnan(values))
    starts = np.flatnonzero(_is_first(bucket))
    lengths = np.diff(np.append(starts, len(times)))
    kept = _is_first(bucket) | _is_last(bucket)
    kept[unknown[_is_first(bucket[unknown]) | _is_last(bucket[unknown])]] = True
    for extreme in (np.fmin, np.fmax):  # these ignore unknown samples
        reached = np.flatnonzero(values == np.repeat(extreme.reduceat(values, starts), lengths))
        kept[reached[_is_first(bucket[reached])]] = True
    return np.flatnonzero(kept)


def _is_first(ascending: NDArray[np.intp]) -> NDArray[np.bool_]:
    """A mask of the numbers that differ from the number before."""
    return np.asarray(np.diff(ascending, prepend=-1) != 0)


def _is_last(ascending: NDArray[np.intp]) -> NDArray[np.bool_]:
    """A mask of the numbers that differ from the next number."""
    return np.asarray(np.diff(ascending, append=-1) != 0)
