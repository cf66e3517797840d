"""Expectations of rules that let the robot run behavior trees, and the verdicts on them."""

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
from heron.variants import Blockage, ExperimentArm

BLOCKED = EXPERIMENTS["blocked"]
TIMES = {ExperimentArm.NONE: 90.0, ExperimentArm.ROSSMARIE: 100.0, ExperimentArm.TREES: 107.0}


def delivered(arm: ExperimentArm, blockage: Blockage, seed: int) -> EpisodeRow:
    """An episode as it is expected."""
    is_short = blockage is Blockage.TROLLEY and arm is ExperimentArm.TREES
    numbers = {
        "completed": 1.0,
        "duration": 45.0 if is_short else TIMES[arm] + 0.01 * seed,
        "interventions": float(arm is ExperimentArm.NONE and blockage is not Blockage.TROLLEY),
        "replanned": 1.0,
        "nearest": 0.4,
        "touched": 0.0,
        "restricted": 0.0,
        "restricted_without_need": 0.0,
    }
    return EpisodeRow(blockage.value, arm.value, seed, numbers)


def of_obstacles(
    blockage: Blockage, changed: ExperimentArm | None = None, **numbers: float
) -> dict[str, ExpectationVerdict]:
    """The verdicts on ten episodes in each arm; numbers of an arm are changed."""
    rows = [delivered(arm, blockage, seed) for seed in range(10) for arm in BLOCKED.arms]
    rows = [
        replace(one, numbers=one.numbers | numbers) if one.arm == changed else one for one in rows
    ]
    (sample,) = (one for one in samples_of(BLOCKED, rows) if one.variant == blockage.value)
    return {expectation.key: expectation.verdict for expectation in expectations_of(sample)}


def test_what_is_expected_of_trees_is_as_expected() -> None:
    found = [of_obstacles(blockage) for blockage in Blockage]
    assert [set(each.values()) for each in found] == [{ExpectationVerdict.HOLDS}] * 3
    assert [len(each) for each in found] == [5, 4, 5]


@pytest.mark.parametrize(
    ("key", "blockage", "arm", "numbers"),
    [
        ("alone trees", Blockage.PALLET, ExperimentArm.TREES, {"interventions": 1.0}),
        ("alone trees", Blockage.BOTH, ExperimentArm.TREES, {"completed": 0.0}),
        ("alone rossmarie", Blockage.TROLLEY, ExperimentArm.ROSSMARIE, {"interventions": 1.0}),
        ("operator", Blockage.PALLET, ExperimentArm.NONE, {"interventions": 0.0}),
        ("little later", Blockage.PALLET, ExperimentArm.TREES, {"duration": 111.0}),
        ("sooner", Blockage.TROLLEY, ExperimentArm.TREES, {"duration": 101.0}),
        ("touches nothing", Blockage.BOTH, ExperimentArm.ROSSMARIE, {"touched": 0.1}),
    ],
)
def test_what_is_otherwise_is_not_as_expected(
    key: str, blockage: Blockage, arm: ExperimentArm, numbers: dict[str, float]
) -> None:
    assert of_obstacles(blockage, arm, **numbers)[key] is ExpectationVerdict.FAILS
