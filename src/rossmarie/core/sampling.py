"""The functions of the last samples of a number, each defined once: S18 to S21, S43, S49, S50.

A member of `Sampling` with its row in `SAMPLINGS` is all that such a function is: an expression
over views of the samples, which whoever remembers samples gives it. A view of samples that are not
there is NaN. Samples are taken, replaced and forgotten alike for all of them (S17, S18, S21).
"""

from __future__ import annotations

import enum
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from rossmarie.core.expressions import Expression, IsUnknown, Number, Operand, choose

MOST_SAMPLES = 64
"""The number of samples that a window holds at the most: the last ones."""


class View(enum.Enum):
    """Numbers that are found among samples."""

    NEWEST = "newest"
    BEFORE = "before"  # the sample before the newest
    SECONDS = "seconds"  # from that to the newest, as a binary64 of nanoseconds divided by 1e9
    LOWER = "lower"  # the middle sample of a window by size; of two, the lower
    UPPER = "upper"  # of two, the upper
    TOTAL = "total"  # the sum of a window, added from the oldest sample to the newest
    COUNT = "count"  # how many samples a window holds
    CONSTANT = "constant"  # the time constant of a filter, in seconds


class Sampling(enum.Enum):
    """Functions of the last samples of a number."""

    RATE = "rate"
    PREVIOUS = "previous"
    MEDIAN = "median"
    MEAN = "mean"
    LOW_PASS = "low_pass"


@dataclass(frozen=True)
class SamplingRow:
    """The description of a function of samples.

    `rule` is its rule in the semantics, `views` are the operands of the expression that `define`
    gives, `phrase` words it, with `{0}` for the number and `{window}` for the time that it takes:
    the length of its window if it `has_window`, the time constant if it `feeds_back`.
    Of one that feeds back the results are remembered instead of the samples: `NEWEST` is the sample
    that comes, `BEFORE` the result at the one before. `at_rest` is the value of a number that does
    not change. Infinite samples are ordinary numbers to some (S8), the others are functions (S4).
    Some `wait`: they are unknown until a sample has come, which is no failure of a sensor (S30).
    """

    rule: str
    views: tuple[View, ...]
    define: Callable[..., Expression]
    phrase: str
    at_rest: Callable[[Expression], Expression]
    keeps_infinities: bool = False
    waits: bool = False
    has_window: bool = False
    feeds_back: bool = False

    @property
    def takes_time(self) -> bool:
        """True if it is given a time."""
        return self.has_window or self.feeds_back

    @property
    def gives_a_sample(self) -> bool:
        """True if the value is one of the samples, of whatever kind these are."""
        return self.expression == Operand(0)

    @property
    def expression(self) -> Expression:
        """The value, with the views as operands."""
        return self.define(*map(Operand, range(len(self.views))))

    def worded(self, number: str, window: str) -> str:
        """The phrase about a number in words, and a window in words."""
        return self.phrase.format(number, window=window)


def _rate(newest: Expression, before: Expression, seconds: Expression) -> Expression:
    """S19."""
    return (newest - before) / seconds


def _median(lower: Expression, upper: Expression) -> Expression:
    """S43."""
    return choose(lower.equals(upper), lower, lower / 2.0 + upper / 2.0)


def _mean(total: Expression, count: Expression) -> Expression:
    """S49."""
    return total / count


def _low_pass(
    newest: Expression, before: Expression, seconds: Expression, constant: Expression
) -> Expression:
    """S50: backward Euler, which is stable however far apart the samples are."""
    step = (seconds / (constant + seconds)) * (newest - before)
    return choose(IsUnknown(before), newest, before + step)


SAMPLINGS: Mapping[Sampling, SamplingRow] = {
    Sampling.RATE: SamplingRow(
        rule="S19",
        views=(View.NEWEST, View.BEFORE, View.SECONDS),
        define=_rate,
        phrase="the rate of change of {0}",
        at_rest=lambda _: Number(0.0),
        waits=True,
    ),
    Sampling.PREVIOUS: SamplingRow(
        rule="S20",
        views=(View.BEFORE,),
        define=lambda before: before,
        phrase="the sample before the last of {0}",
        at_rest=lambda x: x,
        keeps_infinities=True,
        waits=True,
    ),
    Sampling.MEDIAN: SamplingRow(
        rule="S43",
        views=(View.LOWER, View.UPPER),
        define=_median,
        phrase="the median of {0} over {window}",
        at_rest=lambda x: x,
        keeps_infinities=True,
        waits=True,
        has_window=True,
    ),
    Sampling.MEAN: SamplingRow(
        rule="S49",
        views=(View.TOTAL, View.COUNT),
        define=_mean,
        phrase="the mean of {0} over {window}",
        at_rest=lambda x: x,
        waits=True,
        has_window=True,
    ),
    Sampling.LOW_PASS: SamplingRow(
        rule="S50",
        views=(View.NEWEST, View.BEFORE, View.SECONDS, View.CONSTANT),
        define=_low_pass,
        phrase="{0} behind a low pass of {window}",
        at_rest=lambda x: x,
        waits=True,
        feeds_back=True,
    ),
}


def sampling_row(function: Sampling) -> SamplingRow:
    """Find the row of a function of samples."""
    return SAMPLINGS[function]
