"""Expectations, their verdicts, and the expectations that several experiments share."""

from __future__ import annotations

import enum
from dataclasses import dataclass

import numpy as np

from heron.evaluation.sample import Sample
from heron.evaluation.statistics import Estimate, median
from heron.experiments.experiment import ARM_NAMES
from heron.variants import ExperimentArm

_SURE = 0.05
MARGIN = 0.1
"""A tenth more harm, or a tenth more time, counts as the same."""


class ExpectationVerdict(enum.Enum):
    """The verdict on an expectation."""

    HOLDS = "met"
    FAILS = "not met"
    OPEN = "undecided"


@dataclass(frozen=True)
class ResultExpectation:
    """An expectation, its result, and the verdict. Its key does not change when its text does."""

    key: str
    expected: str
    found: str
    verdict: ExpectationVerdict


def between(estimate: Estimate, digits: int) -> str:
    """`1.0 [0.9, 1.2]`; without brackets if all values are the same, or no interval is known."""
    text, low, high = (
        f"{round(number, digits) + 0.0:.{digits}f}"  # no zero with a sign
        for number in (estimate.value, estimate.low, estimate.high)
    )
    return text if np.isnan(estimate.low) or low == high else f"{text} [{low}, {high}]"


def there_is_harm(sample: Sample, harm: str, guarded: ExperimentArm) -> ResultExpectation:
    """Expect more harm without a monitor than with this guard."""
    measure = sample.experiment.measure(harm)
    compared = sample.compared(harm, ExperimentArm.NONE, guarded)
    difference = between(compared.difference, measure.digits)
    return ResultExpectation(
        f"harm {guarded.value} {harm}",
        f"{measure.label}: greater without a monitor than with {ARM_NAMES[guarded]}",
        f"by {difference} {measure.unit}, p = {compared.chance:.2g}",
        greater(compared.difference.value, compared.chance),
    )


def greater(difference: float, chance: float) -> ExpectationVerdict:
    """The verdict on a difference that is expected to be above 0; `chance` is its p."""
    if chance < _SURE:
        return ExpectationVerdict.HOLDS
    return ExpectationVerdict.OPEN if difference > 0 else ExpectationVerdict.FAILS


def as_safe(
    sample: Sample, harm: str, other: ExperimentArm, ours: ExperimentArm = ExperimentArm.ROSSMARIE
) -> ResultExpectation:
    """Expect no more harm than with another guard."""
    measure = sample.experiment.measure(harm)
    found = sample.compared(harm, ours, other).difference
    margin = MARGIN * float(np.median(sample.values(other, harm)))
    return ResultExpectation(
        f"safe {other.value} {harm}",
        f"{measure.label}: with {with_arm(ours)} at most 10 % more than with {with_arm(other)}",
        f"the difference is {between(found, measure.digits)} {measure.unit}",
        at_most(found, margin),
    )


def with_arm(arm: ExperimentArm) -> str:
    """The name of an arm in a sentence."""
    return f"the {ARM_NAMES[arm]}" if arm is ExperimentArm.COLLISION_MONITOR else ARM_NAMES[arm]


def at_most(found: Estimate, most: float) -> ExpectationVerdict:
    """The verdict on an estimate that is expected to be no more than this."""
    if np.isnan(found.low):
        return ExpectationVerdict.OPEN
    if found.high <= most:
        return ExpectationVerdict.HOLDS
    return ExpectationVerdict.FAILS if found.low > most else ExpectationVerdict.OPEN


def acts_in_time(sample: Sample, hazard: str, seconds: float) -> ResultExpectation:
    """Expect a reaction to a hazard within some seconds.

    An episode without a reaction has no value here. The table shows the number of reactions.
    """
    measure = sample.experiment.measure(f"reaction_{hazard}")
    values = sample.values(ExperimentArm.ROSSMARIE, measure.name)
    found = median(values) if values else None
    return ResultExpectation(
        f"in time {hazard}",
        f"{measure.label}: with ROSSMARie within {seconds:g} s",
        "there was no reaction" if found is None else f"{between(found, measure.digits)} s",
        ExpectationVerdict.FAILS if found is None else at_most(found, seconds),
    )
