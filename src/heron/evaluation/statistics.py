"""Summaries of many episodes, with confidence intervals of 95 %."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats

_RESAMPLES = 2000
_LEVEL = 0.95


@dataclass(frozen=True)
class Estimate:
    """A median or a share with its confidence interval. The interval is unknown for a single
    episode.
    """

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class PairedComparison:
    """Differences on the same seeds: their median, and how likely they are that great if there is
    none (Wilcoxon, one-sided: the first ones are greater).
    """

    difference: Estimate
    chance: float


def median(values: Sequence[float]) -> Estimate:
    """Estimate the median with a bootstrap interval. The same values always give the same
    interval.
    """
    value = float(np.median(values))
    if len(values) < 2:
        return Estimate(value, math.nan, math.nan)
    found = stats.bootstrap(
        (np.asarray(values),),
        np.median,
        n_resamples=_RESAMPLES,
        confidence_level=_LEVEL,
        method="percentile",
        rng=np.random.default_rng(0),
    ).confidence_interval
    return Estimate(value, float(found.low), float(found.high))


def share(count: int, total: int) -> Estimate:
    """Estimate a share with a Wilson interval, which also works if all or none of the trials
    count.
    """
    found = stats.binomtest(count, total).proportion_ci(_LEVEL, method="wilson")
    return Estimate(count / total, float(found.low), float(found.high))


def compare(first: Sequence[float], second: Sequence[float]) -> PairedComparison:
    """Compare two samples of the same seeds in the same order."""
    differences = np.asarray(first) - np.asarray(second)
    if not differences.any():
        chance = 1.0
    else:
        chance = float(stats.wilcoxon(differences, alternative="greater").pvalue)
    return PairedComparison(median(differences.tolist()), chance)
