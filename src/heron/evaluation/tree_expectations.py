"""Expectations of rules that run behavior trees, compared with rules that move the robot back and
replan its route.

Section 5.2 of the thesis: a recovery that is a tree can wait, and can report its findings to the
planner.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from heron.evaluation.expectation import (
    MARGIN,
    ExpectationVerdict,
    ResultExpectation,
    at_most,
    between,
    greater,
)
from heron.evaluation.sample import Sample
from heron.experiments.experiment import ARM_NAMES, COMPLETED, DURATION, INTERVENTIONS
from heron.variants import Blockage, ExperimentArm

_TOUCHED = "touched"


def expectations_of_trees(sample: Sample) -> Iterator[ResultExpectation]:
    """All expectations of a variant."""
    yield from (alone(sample, arm) for arm in (ExperimentArm.ROSSMARIE, ExperimentArm.TREES))
    if sample.variant == Blockage.TROLLEY.value:
        yield _sooner(sample)
    else:
        yield _needs_operator(sample)
        yield _little_later(sample)
    yield touches_nothing(sample)


def alone(sample: Sample, arm: ExperimentArm) -> ResultExpectation:
    """Expect that an arm arrives without an operator."""
    done, visits = sample.values(arm, COMPLETED.name), sample.values(arm, INTERVENTIONS.name)
    found = sum(is_done == 1 and came == 0 for is_done, came in zip(done, visits, strict=True))
    return ResultExpectation(
        f"alone {arm.value}",
        f"with {ARM_NAMES[arm]}, the base arrives without an operator in every episode",
        f"in {found} of {sample.count(arm)}",
        ExpectationVerdict.HOLDS if found == sample.count(arm) else ExpectationVerdict.FAILS,
    )


def _needs_operator(sample: Sample) -> ResultExpectation:
    visits = sample.values(ExperimentArm.NONE, INTERVENTIONS.name)
    came = sum(count >= 1 for count in visits)
    return ResultExpectation(
        "operator",
        "without a monitor, an operator must come in every episode",
        f"in {came} of {len(visits)}",
        ExpectationVerdict.HOLDS if came == len(visits) else ExpectationVerdict.FAILS,
    )


def _sooner(sample: Sample) -> ResultExpectation:
    compared = sample.compared(DURATION.name, ExperimentArm.ROSSMARIE, ExperimentArm.TREES)
    return ResultExpectation(
        "sooner",
        "with trees, the base arrives sooner than with ROSSMARie, which takes the long path",
        f"by {between(compared.difference, DURATION.digits)} s, p = {compared.chance:.2g}",
        greater(compared.difference.value, compared.chance),
    )


def _little_later(sample: Sample) -> ResultExpectation:
    found = sample.compared(DURATION.name, ExperimentArm.TREES, ExperimentArm.ROSSMARIE).difference
    usual = float(np.median(sample.values(ExperimentArm.ROSSMARIE, DURATION.name)))
    return ResultExpectation(
        "little later",
        "with trees, which wait first, the base takes at most 10 % longer than with ROSSMARie",
        f"longer by {between(found, DURATION.digits)} s; the usual time is {usual:.1f} s",
        at_most(found, MARGIN * usual),
    )


def touches_nothing(sample: Sample) -> ResultExpectation:
    """Expect that the base stops before obstacles."""
    touched = [value > 0 for arm in sample.arms for value in sample.values(arm, _TOUCHED)]
    return ResultExpectation(
        "touches nothing",
        "the base touches no obstacle in any arm",
        f"the base touches an obstacle in {sum(touched)} of {len(touched)} episodes",
        ExpectationVerdict.FAILS if any(touched) else ExpectationVerdict.HOLDS,
    )
