"""The statistics of a small study, all by SciPy: intervals, comparisons, censored times."""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats

SEED = 20240611
"""Seed of all resampling: the same records give the same figures."""
RESAMPLES = 9999
LEVEL = 0.95


@dataclass(frozen=True)
class Estimate:
    """A mean with its bootstrap interval, which takes two different values at least."""

    count: int
    value: float
    low: float | None
    high: float | None


@dataclass(frozen=True)
class Difference:
    """The difference of two means with its bootstrap interval and a permutation test.

    `p` is exact if the number of partitions is at most `RESAMPLES`.
    """

    value: float
    low: float | None
    high: float | None
    p: float


def mean(values: Sequence[float]) -> Estimate:
    """The mean of some values, with a BCa bootstrap interval at `LEVEL`."""
    low, high = _interval((values,), np.mean)
    return Estimate(len(values), float(np.mean(values)), low, high)


def difference(first: Sequence[float], second: Sequence[float]) -> Difference | None:
    """Compare two groups of participants; none if a group has less than two."""
    if min(len(first), len(second)) < 2:
        return None
    test = stats.permutation_test(
        (first, second),
        _difference_of_means,
        permutation_type="independent",
        vectorized=True,
        n_resamples=RESAMPLES,
        rng=np.random.default_rng(SEED),
    )
    low, high = _interval((first, second), _difference_of_means)
    return Difference(float(test.statistic), low, high, float(test.pvalue))


def adjusted(values: Sequence[float]) -> Sequence[float]:
    """P-values of several tests, adjusted for the false discovery rate (Benjamini-Hochberg)."""
    return [float(each) for each in stats.false_discovery_control(values)] if values else []


def median_time(seconds: Sequence[float], has_ended: Sequence[bool]) -> float | None:
    """The median of times of which some are lower bounds (Kaplan-Meier); none if too few ended."""
    sample = stats.CensoredData.right_censored(seconds, [not each for each in has_ended])
    left = stats.ecdf(sample).sf
    below = np.flatnonzero(left.probabilities <= 0.5)
    return float(left.quantiles[below[0]]) if len(below) else None


def survival(
    seconds: Sequence[float], has_ended: Sequence[bool]
) -> tuple[Sequence[float], Sequence[float]]:
    """Times and the share that has not ended by then (Kaplan-Meier), from 0 s on."""
    sample = stats.CensoredData.right_censored(seconds, [not each for each in has_ended])
    left = stats.ecdf(sample).sf
    return [0.0, *left.quantiles.tolist()], [1.0, *left.probabilities.tolist()]


def _difference_of_means(
    first: np.ndarray, second: np.ndarray, axis: int = -1
) -> np.ndarray | float:
    found: np.ndarray | float = np.mean(first, axis=axis) - np.mean(second, axis=axis)
    return found


def _interval(samples: Sequence[Sequence[float]], statistic: object) -> tuple[float | None, ...]:
    """A BCa interval; none for groups in which all values are the same."""
    if any(len(set(each)) < 2 for each in samples):
        return None, None
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a degenerate distribution gives NaN, which is none here
        found = stats.bootstrap(
            samples,
            statistic,
            n_resamples=RESAMPLES,
            confidence_level=LEVEL,
            method="BCa",
            rng=np.random.default_rng(SEED),
        ).confidence_interval
    return tuple(None if math.isnan(each) else float(each) for each in (found.low, found.high))
