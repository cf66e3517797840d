"""Expectations of rules that know the running skills, compared with the same rules without this
knowledge.

Contact that belongs to a running skill does not stop the robot. All other contact stops it as
before.
"""

from __future__ import annotations

from collections.abc import Iterator

from heron.evaluation.expectation import (
    ExpectationVerdict,
    ResultExpectation,
    as_safe,
    there_is_harm,
    with_arm,
)
from heron.evaluation.sample import Sample
from heron.experiments.experiment import EXEMPTIONS, WITHOUT_NEED
from heron.variants import Encounter, ExperimentArm

_WITHIN_A_SKILL = (Encounter.JAMMED.value,)
"""The variants whose hazard occurs while a skill runs. Rules that know only the sensors stop
the robot before the hazard, so no robot completes the task.
"""


def expectations_of_skills(sample: Sample) -> Iterator[ResultExpectation]:
    """All expectations of a variant."""
    is_within = sample.variant in _WITHIN_A_SKILL
    guarded = (
        (ExperimentArm.SKILL_AWARE,)
        if is_within
        else (ExperimentArm.ROSSMARIE, ExperimentArm.SKILL_AWARE)
    )
    for harm in sample.harms:
        yield from (there_is_harm(sample, harm, arm) for arm in guarded)
        if not is_within:
            yield as_safe(sample, harm, ExperimentArm.ROSSMARIE, ExperimentArm.SKILL_AWARE)
    for hazard, seconds in sample.acts_within.items():
        yield from (_stops(sample, hazard, seconds, arm) for arm in guarded)
    if not is_within:
        yield _finishes(sample)
    if not sample.harms:
        yield _does_not_interfere(sample)
        yield _uses_exemptions(sample)


def _stops(sample: Sample, hazard: str, seconds: float, arm: ExperimentArm) -> ResultExpectation:
    measure = sample.experiment.measure(f"reaction_{hazard}")
    times = sample.values(arm, measure.name)
    stopped, total = sum(time <= seconds for time in times), sample.count(arm)
    return ResultExpectation(
        f"stops {arm.value} {hazard}",
        f"{sample.experiment.hazards[hazard]}: {with_arm(arm)} reacts within {seconds:g} s "
        "in every episode",
        f"in {stopped} of {total}",
        ExpectationVerdict.HOLDS if stopped == total else ExpectationVerdict.FAILS,
    )


def _finishes(sample: Sample) -> ResultExpectation:
    ours, total = (
        sample.completed(ExperimentArm.SKILL_AWARE),
        sample.count(ExperimentArm.SKILL_AWARE),
    )
    theirs, of_them = (
        sample.completed(ExperimentArm.ROSSMARIE),
        sample.count(ExperimentArm.ROSSMARIE),
    )
    return ResultExpectation(
        "finishes",
        "rules that know skills always let the robot complete the task; other rules never do",
        f"the task is completed in {ours} of {total} episodes, and in {theirs} of {of_them}",
        ExpectationVerdict.HOLDS if ours == total and not theirs else ExpectationVerdict.FAILS,
    )


def _does_not_interfere(sample: Sample) -> ResultExpectation:
    times = sample.values(ExperimentArm.SKILL_AWARE, WITHOUT_NEED.name)
    some = sum(time > 0 for time in times)
    return ResultExpectation(
        "no interference",
        "without a hazard, no rule that knows skills interferes",
        f"episodes with interference: {some} of {len(times)}",
        ExpectationVerdict.FAILS if some else ExpectationVerdict.HOLDS,
    )


def _uses_exemptions(sample: Sample) -> ResultExpectation:
    counts = sample.values(ExperimentArm.SKILL_AWARE, EXEMPTIONS.name)
    used = sum(count >= 2 for count in counts)
    return ResultExpectation(
        "exemptions",
        "both skills use their exemptions, and the log reports the uses",
        f"at least two uses in {used} of {len(counts)} episodes",
        ExpectationVerdict.HOLDS if used == len(counts) else ExpectationVerdict.FAILS,
    )
