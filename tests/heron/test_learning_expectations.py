"""Expectations of runs that are planned with what was learned, and the verdicts on them."""

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
from heron.variants import ExperimentArm, Trouble

SECOND = EXPERIMENTS["second"]
IN_THE_WAY = {Trouble.LASTING: 103.0, Trouble.PASSING: 45.0}
FREE, ALWAYS = 39.0, 62.0


def delivered(arm: ExperimentArm, trouble: Trouble, seed: int) -> EpisodeRow:
    """An episode as it is expected; in every fifth, nothing stands in the way."""
    is_blocked = trouble is not Trouble.NONE and seed % 5 > 0
    goes_straight_on = trouble is Trouble.NONE or arm is ExperimentArm.TREES
    is_met = is_blocked and goes_straight_on
    straight_on = IN_THE_WAY[trouble] if is_met else FREE
    numbers = {
        "completed": 1.0,
        "duration": (straight_on if goes_straight_on else ALWAYS) + 0.01 * seed,
        "interventions": 0.0,
        "activations": float(is_met),
        "touched": 0.0,
    }
    return EpisodeRow(trouble.value, arm.value, seed, numbers)


def of_trouble(
    trouble: Trouble, changed: ExperimentArm | None = None, **numbers: float
) -> dict[str, ExpectationVerdict]:
    """The verdicts on ten episodes in each arm; numbers of an arm are changed."""
    rows = [delivered(arm, trouble, seed) for seed in range(10) for arm in SECOND.arms]
    rows = [
        replace(one, numbers=one.numbers | numbers) if one.arm == changed else one for one in rows
    ]
    (sample,) = (one for one in samples_of(SECOND, rows) if one.variant == trouble.value)
    return {expectation.key: expectation.verdict for expectation in expectations_of(sample)}


def test_what_is_expected_of_learning_is_as_expected() -> None:
    found = [of_trouble(trouble) for trouble in Trouble]
    assert [set(each.values()) for each in found] == [{ExpectationVerdict.HOLDS}] * 3
    assert [len(each) for each in found] == [7, 7, 4]
    assert "sooner" in found[0]
    assert "later" in found[1]


@pytest.mark.parametrize(
    ("key", "trouble", "arm", "numbers"),
    [
        ("alone learned", Trouble.LASTING, ExperimentArm.LEARNED, {"interventions": 1.0}),
        ("alone trees", Trouble.NONE, ExperimentArm.TREES, {"completed": 0.0}),
        ("touches nothing", Trouble.PASSING, ExperimentArm.LEARNED, {"touched": 0.1}),
        ("fewer activations", Trouble.LASTING, ExperimentArm.TREES, {"activations": 0.0}),
        ("no activation", Trouble.PASSING, ExperimentArm.LEARNED, {"activations": 1.0}),
        ("sooner", Trouble.LASTING, ExperimentArm.LEARNED, {"duration": 104.0}),
        ("later", Trouble.PASSING, ExperimentArm.LEARNED, {"duration": 38.0}),
        ("later where free", Trouble.PASSING, ExperimentArm.LEARNED, {"duration": 38.0}),
        ("the same", Trouble.NONE, ExperimentArm.LEARNED, {"duration": 39.0}),
    ],
)
def test_what_is_otherwise_is_not_as_expected(
    key: str, trouble: Trouble, arm: ExperimentArm, numbers: dict[str, float]
) -> None:
    assert of_trouble(trouble, arm, **numbers)[key] is ExpectationVerdict.FAILS
