"""Experiment V: a child runs out of a door in the corridor of a school."""

from __future__ import annotations

import json
from functools import cache

import numpy as np
import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from heron.experiments import CorridorEpisode, run_corridor
from heron.experiments.arms import CORRIDOR_RULES
from heron.experiments.corridor import BRISK
from heron.rules import FOLDER
from heron.scene import CorridorParameters
from heron.skills import EXPORT
from heron.variants import ExperimentArm, Passage
from rossmarie.driver.analyze import analyze_file

LATE = 5
"""A seed with a child whom the scanner sees too late at full speed."""


@cache
def episode(
    arm: ExperimentArm, seed: int = LATE, passage: Passage = Passage.CHILD
) -> CorridorEpisode:
    """Each is run once for all tests."""
    return run_corridor(arm, passage, seed)


def test_without_a_monitor_the_child_is_hit_at_full_speed() -> None:
    found = episode(ExperimentArm.NONE).measures
    assert found.is_completed
    assert found.impact == pytest.approx(BRISK.cruise, abs=0.02)


def test_sensors_alone_are_too_late_for_a_child_that_runs_out_right_ahead() -> None:
    found = episode(ExperimentArm.ROSSMARIE)
    assert found.measures.impact is not None
    assert 0.1 < found.measures.impact < 0.9, "it brakes"


def test_who_knows_the_place_stands_before_the_child() -> None:
    found = episode(ExperimentArm.PROACTIVE)
    assert found.measures.is_completed
    assert found.measures.impact == 0.0
    assert found.measures.nearest is not None
    assert found.measures.nearest > 0.1


def test_the_speed_is_what_the_rule_keeps() -> None:
    """`keeps drive below 0.5 m/s in SchoolCorridor` is proved; wheels swing a little around it."""
    trace = episode(ExperimentArm.PROACTIVE, passage=Passage.EMPTY).trace
    begin, end = CorridorParameters().school
    inside = (trace.columns["x"] > begin) & (trace.columns["x"] < end)
    assert inside.any()
    assert float(trace.columns["speed"][inside].max()) < 0.51
    before = trace.columns["x"] < begin - 3.0
    assert float(trace.columns["speed"][before].max()) == pytest.approx(BRISK.cruise, abs=0.02)


def test_nobody_is_delayed_by_more_than_a_tenth() -> None:
    usual = episode(ExperimentArm.ROSSMARIE, passage=Passage.EMPTY).measures.duration
    assert episode(ExperimentArm.PROACTIVE, passage=Passage.EMPTY).measures.duration < 1.1 * usual
    assert episode(ExperimentArm.SKILL_AWARE, passage=Passage.EMPTY).measures.duration > 1.5 * usual


def test_a_robot_that_is_slow_all_the_way_stands_as_well() -> None:
    assert episode(ExperimentArm.SKILL_AWARE).measures.impact == 0.0


def test_it_is_the_same_episode_each_time() -> None:
    again = run_corridor(ExperimentArm.PROACTIVE, Passage.CHILD, LATE)
    assert again.measures == episode(ExperimentArm.PROACTIVE).measures
    assert np.array_equal(
        again.trace.columns["x"], episode(ExperimentArm.PROACTIVE).trace.columns["x"]
    )


def test_the_scene_of_the_skills_is_the_scene_of_the_physics() -> None:
    (school,) = json.loads(EXPORT.read_text(encoding="utf-8"))["locations"]
    low, high = CorridorParameters().school
    half = CorridorParameters().half_width
    corners = {tuple(corner) for corner in school["corners"]}
    assert corners == {(x, y) for x in (low, high) for y in (-half, half)}


@pytest.mark.parametrize("arm", CORRIDOR_RULES)
def test_the_rules_have_no_findings_but_the_proof(arm: ExperimentArm) -> None:
    found = analyze_file(CORRIDOR_RULES[arm], thorough=True).diagnostics
    codes = {each.code for each in found if each.code != "ROSS729"}
    assert codes == ({"ROSS722"} if arm is ExperimentArm.PROACTIVE else set())
    assert CORRIDOR_RULES[arm].parent == FOLDER
