"""Expectations of rules that know which skills run, and the verdicts on them."""

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
from heron.variants import Encounter, ExperimentArm

CONTACT = EXPERIMENTS["contact"]


def touched(arm: ExperimentArm, encounter: Encounter, seed: int) -> EpisodeRow:
    """An episode as it is expected."""
    is_aware, is_guarded = arm is ExperimentArm.SKILL_AWARE, arm is not ExperimentArm.NONE
    numbers = {measure.name: 0.0 for measure in CONTACT.measures if "reaction" not in measure.name}
    numbers |= {
        "completed": float(arm is not ExperimentArm.ROSSMARIE),
        "exemptions": 3.0 * is_aware,
    }
    harm = (0.5 if is_guarded else 1.0) + 0.001 * seed
    match encounter:
        case Encounter.COLLISION:
            numbers |= {"peak_on_person": 200 * harm, "time_on_person": harm}
            numbers |= {"reaction_collision": 0.05} if is_guarded else {}
        case Encounter.JAMMED if arm is ExperimentArm.ROSSMARIE:
            numbers = {name: value for name, value in numbers.items() if "jam" not in name}
        case Encounter.JAMMED:
            numbers |= {"completed": 0.0, "peak_in_jam": 100 * harm, "time_in_jam": harm}
            numbers |= {"reaction_jam": 0.1} if is_guarded else {}
        case Encounter.MEANT:
            pass
    return EpisodeRow(encounter.value, arm.value, seed, numbers)


def of_contacts(
    encounter: Encounter, changed: ExperimentArm | None = None, **numbers: float
) -> dict[str, ExpectationVerdict]:
    """The verdicts on ten episodes in each arm; numbers of an arm are changed."""
    rows = [touched(arm, encounter, seed) for seed in range(10) for arm in CONTACT.arms]
    rows = [
        replace(one, numbers=one.numbers | numbers) if one.arm == changed else one for one in rows
    ]
    (sample,) = (one for one in samples_of(CONTACT, rows) if one.variant == encounter.value)
    return {expectation.key: expectation.verdict for expectation in expectations_of(sample)}


def test_what_is_expected_of_skills_is_as_expected() -> None:
    found = [of_contacts(encounter) for encounter in Encounter]
    assert [set(each.values()) for each in found] == [{ExpectationVerdict.HOLDS}] * 3
    assert [len(each) for each in found] == [9, 3, 3]


@pytest.mark.parametrize(
    ("key", "encounter", "arm", "numbers"),
    [
        ("finishes", Encounter.MEANT, ExperimentArm.SKILL_AWARE, {"completed": 0.0}),
        ("finishes", Encounter.MEANT, ExperimentArm.ROSSMARIE, {"completed": 1.0}),
        ("no interference", Encounter.MEANT, ExperimentArm.SKILL_AWARE,
         {"restricted_without_need": 0.1}),
        ("exemptions", Encounter.MEANT, ExperimentArm.SKILL_AWARE, {"exemptions": 1.0}),
        ("safe rossmarie peak_on_person", Encounter.COLLISION, ExperimentArm.SKILL_AWARE,
         {"peak_on_person": 115.0}),
        ("stops skill_aware collision", Encounter.COLLISION, ExperimentArm.SKILL_AWARE,
         {"reaction_collision": 0.2}),
        ("harm skill_aware peak_in_jam", Encounter.JAMMED, ExperimentArm.SKILL_AWARE,
         {"peak_in_jam": 120.0}),
        ("stops skill_aware jam", Encounter.JAMMED, ExperimentArm.SKILL_AWARE,
         {"reaction_jam": 0.4}),
    ],
)  # fmt: skip
def test_what_is_not_as_expected_of_skills_is_reported(
    key: str, encounter: Encounter, arm: ExperimentArm, numbers: dict[str, float]
) -> None:
    found = of_contacts(encounter, arm, **numbers)
    assert {name for name, verdict in found.items() if verdict is ExpectationVerdict.FAILS} == {key}


def test_a_contact_that_nobody_acts_on_is_reported() -> None:
    rows = [touched(arm, Encounter.COLLISION, seed) for seed in range(10) for arm in CONTACT.arms]
    del rows[2].numbers["reaction_collision"]
    (sample,) = (one for one in samples_of(CONTACT, rows) if one.harms)
    (expectation,) = (
        one for one in expectations_of(sample) if one.key == "stops skill_aware collision"
    )
    assert (expectation.found, expectation.verdict) == ("in 9 of 10", ExpectationVerdict.FAILS)
