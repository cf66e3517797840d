"""Expectations of the arms, and their verdicts.

The thesis claims: without a monitor the robot finishes fast but causes harm. DeROS is safe but
waits for its operator. ROSSMARie is as safe and finishes without an operator.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from heron.evaluation.expectation import (
    MARGIN,
    ExpectationVerdict,
    ResultExpectation,
    acts_in_time,
    as_safe,
    at_most,
    between,
    greater,
    there_is_harm,
    with_arm,
)
from heron.evaluation.learning_expectations import expectations_of_learning
from heron.evaluation.place_expectations import expectations_of_places
from heron.evaluation.sample import Sample
from heron.evaluation.skill_expectations import expectations_of_skills
from heron.evaluation.tree_expectations import expectations_of_trees
from heron.experiments.experiment import ARM_NAMES, DURATION, INTERVENTIONS, WITHOUT_NEED
from heron.variants import ExperimentArm


def expectations_of(sample: Sample) -> Iterator[ResultExpectation]:
    """All expectations of a variant."""
    if ExperimentArm.LEARNED in sample.arms:
        yield from expectations_of_learning(sample)
        return
    if ExperimentArm.TREES in sample.arms:
        yield from expectations_of_trees(sample)
        return
    if ExperimentArm.PROACTIVE in sample.arms:
        yield from expectations_of_places(sample)
        return
    if ExperimentArm.SKILL_AWARE in sample.arms:
        yield from expectations_of_skills(sample)
        return
    if not sample.harms:
        yield _everybody_finishes(sample)
        yield _nobody_interferes(sample)
        return
    for harm in sample.harms:
        yield there_is_harm(sample, harm, ExperimentArm.DEROS)
        yield there_is_harm(sample, harm, ExperimentArm.ROSSMARIE)
        yield from (as_safe(sample, harm, other) for other in _others(sample))
    for gain in sample.gains:
        yield from (_better(sample, gain, other) for other in _others(sample))
    for hazard, seconds in sample.acts_within.items():
        yield acts_in_time(sample, hazard, seconds)
    yield _unguarded_is_fastest(sample)
    yield _finishes_with_operator(sample)
    yield _finishes_alone(sample)
    yield _sooner(sample)
    if ExperimentArm.COLLISION_MONITOR in sample.arms:
        yield _does_as_much(sample)


def _others(sample: Sample) -> list[ExperimentArm]:
    """The guards that ROSSMARie is compared with."""
    return [arm for arm in sample.arms if arm not in (ExperimentArm.NONE, ExperimentArm.ROSSMARIE)]


def _better(sample: Sample, gain: str, other: ExperimentArm) -> ResultExpectation:
    measure = sample.experiment.measure(gain)
    compared = sample.compared(gain, ExperimentArm.ROSSMARIE, other)
    return ResultExpectation(
        f"better {other.value} {gain}",
        f"{measure.label}: more with ROSSMARie than with {with_arm(other)}",
        f"by {between(compared.difference, measure.digits)} {measure.unit}, "
        f"p = {compared.chance:.2g}",
        greater(compared.difference.value, compared.chance),
    )


def _does_as_much(sample: Sample) -> ResultExpectation:
    """Times are compared where both arms always finish."""
    other = ExperimentArm.COLLISION_MONITOR
    ours, theirs = sample.completed(ExperimentArm.ROSSMARIE), sample.completed(other)
    found = sample.compared(DURATION.name, ExperimentArm.ROSSMARIE, other).difference
    if theirs == sample.count(other):
        margin = MARGIN * float(np.median(sample.values(other, DURATION.name)))
        verdict = (
            at_most(found, margin)
            if ours == sample.count(ExperimentArm.ROSSMARIE)
            else ExpectationVerdict.FAILS
        )
    else:
        verdict = ExpectationVerdict.HOLDS if ours >= theirs else ExpectationVerdict.FAILS
    return ResultExpectation(
        "does as much",
        "with ROSSMARie the robot finishes at least as often as with the collision monitor; if "
        "both always finish, ROSSMARie takes at most 10 % longer",
        f"{ours} and {theirs} episodes finish; ROSSMARie takes longer by "
        f"{between(found, DURATION.digits)} s",
        verdict,
    )


def _unguarded_is_fastest(sample: Sample) -> ResultExpectation:
    times = {arm: float(np.median(sample.values(arm, DURATION.name))) for arm in sample.arms}
    completed, total = sample.completed(ExperimentArm.NONE), sample.count(ExperimentArm.NONE)
    is_fastest = times[ExperimentArm.NONE] == min(times.values())
    return ResultExpectation(
        "fastest",
        "without a monitor the robot finishes, and is the fastest",
        f"the robot finishes in {completed} of {total} episodes, and takes "
        f"{times[ExperimentArm.NONE]:.1f} s; {times[ExperimentArm.ROSSMARIE]:.1f} s with ROSSMARie",
        ExpectationVerdict.HOLDS if completed == total and is_fastest else ExpectationVerdict.FAILS,
    )


def _finishes_with_operator(sample: Sample) -> ResultExpectation:
    visits = sample.values(ExperimentArm.DEROS, INTERVENTIONS.name)
    completed, total = sample.completed(ExperimentArm.DEROS), sample.count(ExperimentArm.DEROS)
    return ResultExpectation(
        "operator",
        "with DeROS the robot finishes after an operator has come",
        f"the robot finishes in {completed} of {total} episodes; "
        f"the operator came in {sum(count > 0 for count in visits)} episodes, "
        f"{sum(visits):.0f} times in total",
        ExpectationVerdict.HOLDS
        if completed == total and min(visits) > 0
        else ExpectationVerdict.FAILS,
    )


def _finishes_alone(sample: Sample) -> ResultExpectation:
    visits = sample.values(ExperimentArm.ROSSMARIE, INTERVENTIONS.name)
    completed, total = (
        sample.completed(ExperimentArm.ROSSMARIE),
        sample.count(ExperimentArm.ROSSMARIE),
    )
    return ResultExpectation(
        "alone",
        "with ROSSMARie the robot finishes without an operator",
        f"the robot finishes in {completed} of {total} episodes; "
        f"the operator came {sum(visits):.0f} times",
        ExpectationVerdict.HOLDS
        if completed == total and sum(visits) == 0
        else ExpectationVerdict.FAILS,
    )


def _sooner(sample: Sample) -> ResultExpectation:
    compared = sample.compared(DURATION.name, ExperimentArm.DEROS, ExperimentArm.ROSSMARIE)
    return ResultExpectation(
        "sooner",
        "the robot finishes sooner with ROSSMARie than with DeROS",
        f"by {between(compared.difference, DURATION.digits)} s, p = {compared.chance:.2g}",
        greater(compared.difference.value, compared.chance),
    )


def _everybody_finishes(sample: Sample) -> ResultExpectation:
    found = {ARM_NAMES[arm]: (sample.completed(arm), sample.count(arm)) for arm in sample.arms}
    words = "; ".join(f"{name}: {done} of {total}" for name, (done, total) in found.items())
    all_do = all(done == total for done, total in found.values())
    return ResultExpectation(
        "all finish",
        "without a hazard, every arm completes the task",
        words,
        ExpectationVerdict.HOLDS if all_do else ExpectationVerdict.FAILS,
    )


def _nobody_interferes(sample: Sample) -> ResultExpectation:
    guarded = (ExperimentArm.DEROS, ExperimentArm.ROSSMARIE)
    needless = {arm: sample.values(arm, WITHOUT_NEED.name) for arm in guarded}
    found = {arm: (sum(time > 0 for time in times), len(times)) for arm, times in needless.items()}
    words = "; ".join(
        f"{ARM_NAMES[arm]}: in {some} of {all_}" for arm, (some, all_) in found.items()
    )
    return ResultExpectation(
        "no interference",
        "without a hazard, no rule interferes",
        f"episodes with interference: {words}",
        ExpectationVerdict.FAILS
        if any(some for some, _ in found.values())
        else ExpectationVerdict.HOLDS,
    )
