"""Experiment VI: something stands across the short way to a hall."""

from __future__ import annotations

import json
from functools import cache

import numpy as np
import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from heron.experiments import BlockedEpisode, run_blocked
from heron.experiments.arms import BLOCKED_RULES
from heron.experiments.obstacles import varied
from heron.rules import FOLDER
from heron.scene import PathsParameters
from heron.skills import EXPORT
from heron.skills import FOLDER as SKILLS
from heron.tasks import TaskStatus
from heron.variants import Blockage, ExperimentArm
from rossmarie.driver.analyze import analyze_file

SEED = 1


@cache
def episode(arm: ExperimentArm, blockage: Blockage = Blockage.PALLET) -> BlockedEpisode:
    """Each is run once for all tests."""
    return run_blocked(arm, blockage, SEED)


def labels(found: BlockedEpisode) -> list[str]:
    """The skills that have started."""
    return [each.label for each in found.tree if each.spans]


def goes_by_the_yard(found: BlockedEpisode) -> bool:
    return float(found.trace.columns["y"].min()) < PathsParameters().yard[1] / 2


def test_without_a_monitor_an_operator_clears_the_way() -> None:
    found = episode(ExperimentArm.NONE)
    assert found.outcome is TaskStatus.COMPLETED
    assert found.measures.interventions == 1
    assert not goes_by_the_yard(found)


def test_moving_back_and_replanning_takes_the_other_route() -> None:
    found = episode(ExperimentArm.ROSSMARIE)
    assert found.outcome is TaskStatus.COMPLETED
    assert found.measures.interventions == 0
    assert found.measures.replanned == 1
    assert goes_by_the_yard(found)


def test_a_tree_waits_turns_back_and_marks_the_way_and_the_planner_finds_the_other() -> None:
    found = episode(ExperimentArm.TREES)
    assert found.outcome is TaskStatus.COMPLETED
    assert found.measures.interventions == 0
    assert found.measures.replanned == 1
    assert goes_by_the_yard(found)
    steps = ["give_way", "WaitUntilFree(Seconds)", "TurnBack", "MarkAsBlocked"]
    assert labels(found)[3:7] == steps


def test_a_tree_that_waits_long_enough_takes_the_short_way() -> None:
    found = episode(ExperimentArm.TREES, Blockage.TROLLEY)
    assert found.measures.interventions == 0
    assert not goes_by_the_yard(found)
    assert "TurnBack" not in labels(found)
    back = episode(ExperimentArm.ROSSMARIE, Blockage.TROLLEY)
    assert goes_by_the_yard(back)
    assert found.measures.duration < 0.6 * back.measures.duration


def test_a_second_tree_waits_on_the_second_way() -> None:
    found = episode(ExperimentArm.TREES, Blockage.BOTH)
    assert found.outcome is TaskStatus.COMPLETED
    assert found.measures.interventions == 0
    assert found.measures.replanned == 2
    assert labels(found).count("give_way") == 2


@pytest.mark.parametrize("blockage", Blockage)
@pytest.mark.parametrize("arm", [ExperimentArm.NONE, ExperimentArm.ROSSMARIE, ExperimentArm.TREES])
def test_the_base_stands_before_what_is_in_its_way(arm: ExperimentArm, blockage: Blockage) -> None:
    measures = episode(arm, blockage).measures
    assert measures.touched == 0.0
    assert 0.2 < measures.nearest < 0.6


def test_rules_act_two_seconds_after_the_base_has_stopped() -> None:
    trace = episode(ExperimentArm.TREES).trace
    onset = episode(ExperimentArm.TREES).onsets["blocked"]
    stands = trace.times[(trace.times > onset) & (trace.columns["speed"] < 0.02)][0]
    acts = trace.times[trace.columns["is_restricted"] > 0][0]
    assert acts - stands == pytest.approx(2.0, abs=0.5)


def test_a_tree_is_no_restriction_without_need() -> None:
    measures = episode(ExperimentArm.TREES).measures
    assert measures.time_restricted > 20.0, "it waits and turns back"
    assert measures.time_restricted_without_need == 0.0


def test_it_is_the_same_episode_each_time() -> None:
    again = run_blocked(ExperimentArm.TREES, Blockage.PALLET, SEED)
    assert again.measures == episode(ExperimentArm.TREES).measures
    assert again.tree == episode(ExperimentArm.TREES).tree
    for name, column in again.trace.columns.items():
        assert np.array_equal(column, episode(ExperimentArm.TREES).trace.columns[name])


def test_obstacles_differ_from_seed_to_seed_and_not_from_arm_to_arm() -> None:
    assert episode(ExperimentArm.NONE).obstacles == episode(ExperimentArm.TREES).obstacles
    paths = PathsParameters()
    for blockage, count in ((Blockage.PALLET, 1), (Blockage.TROLLEY, 1), (Blockage.BOTH, 2)):
        draws = [varied(blockage, paths, np.random.default_rng(seed)) for seed in range(20)]
        assert {len(each) for each in draws} == {count}
        assert len({each[0].along for each in draws}) == 20
        stays = [each.stay_s for draw in draws for each in draw if each.name == "trolley"]
        assert all(stay is not None and 3.0 <= stay <= 8.0 for stay in stays)
        assert bool(stays) == (blockage is not Blockage.PALLET)


def test_the_world_model_knows_the_ways_of_the_scene() -> None:
    scene = (SKILLS / "blocked.turtle").read_text(encoding="utf-8")
    for name, label in (("3", "junction"), ("4", "hall"), ("5", "yard")):
        assert f'heron:Place-{name} a heron:Place ; rdfs:label "{label}"' in scene


def test_rules_know_the_tree() -> None:
    skills = json.loads(EXPORT.read_text(encoding="utf-8"))["skills"]
    assert "GiveWay" in {each["name"] for each in skills}


@pytest.mark.parametrize("arm", BLOCKED_RULES)
def test_the_rules_have_no_findings(arm: ExperimentArm) -> None:
    found = analyze_file(BLOCKED_RULES[arm], thorough=True).diagnostics
    assert {each.code for each in found} <= {"ROSS729"}
    assert BLOCKED_RULES[arm].parent == FOLDER
