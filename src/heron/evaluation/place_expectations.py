"""Expectations of rules that look ahead, compared with rules that only see a hazard when it is
present.

Section 5 of the thesis: sensor values sometimes reveal a hazard too late. Rules that read the world
model act in time, and cost little when no person is present.
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
    there_is_harm,
)
from heron.evaluation.sample import Sample
from heron.experiments.experiment import ARM_NAMES, DURATION
from heron.variants import ExperimentArm

_SENSORS, _SKILLS, _PLACES = (
    ExperimentArm.ROSSMARIE,
    ExperimentArm.SKILL_AWARE,
    ExperimentArm.PROACTIVE,
)
_IMPACT = "impact"


def expectations_of_places(sample: Sample) -> Iterator[ResultExpectation]:
    """All expectations of a variant."""
    yield _everybody_arrives(sample)
    if sample.harms:
        for harm in sample.harms:
            yield there_is_harm(sample, harm, _SENSORS)
            yield _less(sample, harm)
        yield _too_late(sample)
        yield from (_stands_before(sample, arm) for arm in (_SKILLS, _PLACES))
    yield _costs_little(sample)
    yield _sooner_than_with_skills(sample)


def _everybody_arrives(sample: Sample) -> ResultExpectation:
    found = {ARM_NAMES[arm]: (sample.completed(arm), sample.count(arm)) for arm in sample.arms}
    return ResultExpectation(
        "arrives",
        "the base arrives in every arm",
        "; ".join(f"{name}: {done} of {total}" for name, (done, total) in found.items()),
        ExpectationVerdict.HOLDS
        if all(a == b for a, b in found.values())
        else ExpectationVerdict.FAILS,
    )


def _less(sample: Sample, harm: str) -> ResultExpectation:
    measure = sample.experiment.measure(harm)
    compared = sample.compared(harm, _SENSORS, _PLACES)
    return ResultExpectation(
        f"less {harm}",
        f"{measure.label}: greater with rules that know only the sensors than with rules that "
        "know places",
        f"by {between(compared.difference, measure.digits)} {measure.unit}, "
        f"p = {compared.chance:.2g}",
        greater(compared.difference.value, compared.chance),
    )


def _hits(sample: Sample, arm: ExperimentArm) -> tuple[int, int]:
    """The episodes in which the base moved while it touched the child, and all."""
    return sum(value > 0 for value in sample.values(arm, _IMPACT)), sample.count(arm)


def _too_late(sample: Sample) -> ResultExpectation:
    hits, total = _hits(sample, _SENSORS)
    return ResultExpectation(
        "too late",
        "rules that know only the sensors are too late in some episodes",
        f"the base hits the child in {hits} of {total}",
        ExpectationVerdict.HOLDS if hits else ExpectationVerdict.FAILS,
    )


def _stands_before(sample: Sample, arm: ExperimentArm) -> ResultExpectation:
    hits, total = _hits(sample, arm)
    return ResultExpectation(
        f"stands {arm.value}",
        f"with {ARM_NAMES[arm]} the base stops before it touches the child, in every episode",
        f"in {total - hits} of {total}",
        ExpectationVerdict.FAILS if hits else ExpectationVerdict.HOLDS,
    )


def _costs_little(sample: Sample) -> ResultExpectation:
    found = sample.compared(DURATION.name, _PLACES, _SENSORS).difference
    usual = float(np.median(sample.values(_SENSORS, DURATION.name)))
    return ResultExpectation(
        "costs little",
        "with rules that know places, the base takes at most 10 % longer than with rules that know "
        "only the sensors",
        f"longer by {between(found, DURATION.digits)} s; the usual time is {usual:.1f} s",
        at_most(found, MARGIN * usual),
    )


def _sooner_than_with_skills(sample: Sample) -> ResultExpectation:
    compared = sample.compared(DURATION.name, _SKILLS, _PLACES)
    return ResultExpectation(
        "sooner than skills",
        "with rules that know places, the base arrives sooner than with rules that know only the "
        "skills and slow the base down on the whole path",
        f"by {between(compared.difference, DURATION.digits)} s, p = {compared.chance:.2g}",
        greater(compared.difference.value, compared.chance),
    )
