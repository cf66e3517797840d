"""Expectations of rules that know places, and the verdicts on them."""

from __future__ import annotations

from dataclasses import replace

import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from heron.evaluation import EpisodeRow
from heron.evaluation.expectation import ExpectationVerdict
from heron.evaluation.expectations import expectations_of
from heron.evaluation.sample import samples_of
from heron.experiments import EXPERIMENTS
from heron.variants import ExperimentArm, Passage

CORRIDOR = EXPERIMENTS["corridor"]
TIMES = {
    ExperimentArm.NONE: 58.0,
    ExperimentArm.ROSSMARIE: 60.0,
    ExperimentArm.SKILL_AWARE: 110.0,
    ExperimentArm.PROACTIVE: 65.0,
}


def driven(arm: ExperimentArm, passage: Passage, seed: int) -> EpisodeRow:
    """An episode as it is expected."""
    numbers = {"completed": 1.0, "duration": TIMES[arm] + 0.01 * seed, "interventions": 0.0}
    numbers |= {"restricted": 0.0, "restricted_without_need": 0.0}
    if passage is Passage.CHILD:
        speed = {ExperimentArm.NONE: 1.0, ExperimentArm.ROSSMARIE: 0.4 + 0.01 * seed}.get(arm, 0.0)
        numbers |= {"nearest": 0.1, "fastest_near": speed, "impact": speed}
    return EpisodeRow(passage.value, arm.value, seed, numbers)


def of_children(
    passage: Passage, changed: ExperimentArm | None = None, **numbers: float
) -> dict[str, ExpectationVerdict]:
    """The verdicts on ten episodes in each arm; numbers of an arm are changed."""
    rows = [driven(arm, passage, seed) for seed in range(10) for arm in CORRIDOR.arms]
    rows = [
        replace(one, numbers=one.numbers | numbers) if one.arm == changed else one for one in rows
    ]
    (sample,) = (one for one in samples_of(CORRIDOR, rows) if one.variant == passage.value)
    return {expectation.key: expectation.verdict for expectation in expectations_of(sample)}


def test_what_is_expected_of_places_is_as_expected() -> None:
    found = [of_children(passage) for passage in Passage]
    assert [set(each.values()) for each in found] == [{ExpectationVerdict.HOLDS}] * 2
    assert [len(each) for each in found] == [10, 3]


@pytest.mark.parametrize(
    ("key", "arm", "numbers"),
    [
        ("arrives", ExperimentArm.SKILL_AWARE, {"completed": 0.0}),
        ("stands proactive", ExperimentArm.PROACTIVE, {"impact": 0.01}),
        ("stands skill_aware", ExperimentArm.SKILL_AWARE, {"impact": 0.01}),
        ("too late", ExperimentArm.ROSSMARIE, {"impact": 0.0}),
        ("less impact", ExperimentArm.PROACTIVE, {"impact": 0.8}),
        ("costs little", ExperimentArm.PROACTIVE, {"duration": 67.0}),
        ("sooner than skills", ExperimentArm.SKILL_AWARE, {"duration": 60.0}),
    ],
)
def test_what_is_otherwise_is_not_as_expected(
    key: str, arm: ExperimentArm, numbers: dict[str, float]
) -> None:
    assert of_children(Passage.CHILD, arm, **numbers)[key] is ExpectationVerdict.FAILS
