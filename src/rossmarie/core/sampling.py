"""The functions of the last samples of a number, each defined once: S18 to S21, S43, S49, S50.

A member of `Sampling` and its row in `SAMPLINGS` define such a function completely: an expression
over views of the samples. The code that stores samples provides the views. A view of missing
samples is NaN. Samples are taken, replaced and forgotten in the same way for all functions (S17,
S18, S21).
"""

from __future__ import annotations

import enum
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from rossmarie.core.expressions import ConstantNumber, Expression, IsUnknown, Operand, choose

MOST_SAMPLES = 64
"""The greatest number of samples in a window. The window keeps the newest samples."""


class SampleNumber(enum.Enum):
    """Numbers that are derived from samples."""

    NEWEST = "newest"
    BEFORE = "before"  # the sample before the newest
    # the time from that sample to the newest, as a binary64 of nanoseconds divided by 1e9
    SECONDS = "seconds"
    LOWER = "lower"  # the middle sample of a window by size; of two, the lower
    UPPER = "upper"  # the middle sample; of two, the upper
    TOTAL = "total"  # the sum of a window, added from the oldest sample to the newest
    COUNT = "count"  # the number of samples in a window
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

    `rule` is its rule in the semantics. `views` are the operands of the expression that `define`
    gives. `phrase` is its wording, with `{0}` for the number and `{window}` for its time: the
    length of its window if it `has_window`, the time constant if it `feeds_back`. A function that
    feeds back stores its results instead of samples: `NEWEST` is the new sample, `BEFORE` the
    previous result. `at_rest` is the value for a number that does not change. For some functions,
    infinite samples are ordinary numbers (S8); for other functions, S4 applies. Functions that
    `wait` are unknown until a sample has come, which is not a sensor failure (S30).
    """

    rule: str
    views: tuple[SampleNumber, ...]
    define: Callable[..., Expression]
    phrase: str
    at_rest: Callable[[Expression], Expression]
    keeps_infinities: bool = False
    waits: bool = False
    has_window: bool = False
    feeds_back: bool = False

    @property
    def takes_time(self) -> bool:
        """True if the function has a time."""
        return self.has_window or self.feeds_back

    @property
    def gives_a_sample(self) -> bool:
        """True if the value is one of the samples, whatever the type of the samples."""
        return self.expression == Operand(0)

    @property
    def expression(self) -> Expression:
        """The value, with the views as operands."""
        return self.define(*map(Operand, range(len(self.views))))

    def worded(self, number: str, window: str) -> str:
        """The phrase with the number and the window in words."""
        return self.phrase.format(number, window=window)


def _rate(newest: Expression, before: Expression, seconds: Expression) -> Expression:
    """S19: the rate of change."""
    return (newest - before) / seconds


def _median(lower: Expression, upper: Expression) -> Expression:
    """S43: the median."""
    return choose(lower.equals(upper), lower, lower / 2.0 + upper / 2.0)


def _mean(total: Expression, count: Expression) -> Expression:
    """S49: the mean."""
    return total / count


def _low_pass(
    newest: Expression, before: Expression, seconds: Expression, constant: Expression
) -> Expression:
    """S50: backward Euler, which is stable for any time between the samples."""
    step = (seconds / (constant + seconds)) * (newest - before)
    return choose(IsUnknown(before), newest, before + step)


SAMPLINGS: Mapping[Sampling, SamplingRow] = {
    Sampling.RATE: SamplingRow(
        rule="S19",
        views=(SampleNumber.NEWEST, SampleNumber.BEFORE, SampleNumber.SECONDS),
        define=_rate,
        phrase="the rate of change of {0}",
        at_rest=lambda _: ConstantNumber(0.0),
        waits=True,
    ),
    Sampling.PREVIOUS: SamplingRow(
        rule="S20",
        views=(SampleNumber.BEFORE,),
        define=lambda before: before,
        phrase="the sample before the last of {0}",
        at_rest=lambda x: x,
        keeps_infinities=True,
        waits=True,
    ),
    Sampling.MEDIAN: SamplingRow(
        rule="S43",
        views=(SampleNumber.LOWER, SampleNumber.UPPER),
        define=_median,
        phrase="the median of {0} over {window}",
        at_rest=lambda x: x,
        keeps_infinities=True,
        waits=True,
        has_window=True,
    ),
    Sampling.MEAN: SamplingRow(
        rule="S49",
        views=(SampleNumber.TOTAL, SampleNumber.COUNT),
        define=_mean,
        phrase="the mean of {0} over {window}",
        at_rest=lambda x: x,
        waits=True,
        has_window=True,
    ),
    Sampling.LOW_PASS: SamplingRow(
        rule="S50",
        views=(
            SampleNumber.NEWEST,
            SampleNumber.BEFORE,
            SampleNumber.SECONDS,
            SampleNumber.CONSTANT,
        ),
        define=_low_pass,
        phrase="{0} behind a low pass of {window}",
        at_rest=lambda x: x,
        waits=True,
        feeds_back=True,
    ),
}


def sampling_row(function: Sampling) -> SamplingRow:
    """The row of a function of samples."""
    return SAMPLINGS[function]
