"""Experiment II: what the thesis says of its three arms, in physics."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from heron.experiments import PlacingEpisode, run_placing
from heron.robot.admittance import Admittance
from heron.robot.arm import Arm as RobotArm
from heron.scene import ArmParameters, TableParameters, build_placing
from heron.variants import ExperimentArm, Table

SEED = 3


@cache
def episode(arm: ExperimentArm, table: Table) -> PlacingEpisode:
    """Each is run once for all tests."""
    return run_placing(arm, table, SEED)


def test_the_same_seed_is_the_same_episode() -> None:
    first, again = (
        episode(ExperimentArm.ROSSMARIE, Table.HIGH),
        run_placing(ExperimentArm.ROSSMARIE, Table.HIGH, SEED),
    )
    assert (first.measures, first.reported) == (again.measures, again.reported)
    assert np.array_equal(first.trace.columns["force"], again.trace.columns["force"])


def test_where_the_table_is_as_expected_nobody_interferes() -> None:
    found = episode(ExperimentArm.ROSSMARIE, Table.EXPECTED)
    assert found.measures.is_completed
    assert found.reported == ()
    assert found.measures.time_restricted == 0.0
    assert found.measures.peak_force < 10.0


def test_without_a_monitor_the_arm_hammers_on_the_table() -> None:
    found = episode(ExperimentArm.NONE, Table.HIGH)
    force = found.trace.columns["force"]
    turns = np.diff(np.sign(np.diff(force[np.abs(force) > 8.0])))
    assert np.count_nonzero(turns) > 10
    assert found.measures.time_above_30_n > 0.5


def test_with_rules_that_recover_it_softens_retracts_and_places() -> None:
    found = episode(ExperimentArm.ROSSMARIE, Table.HIGH)
    assert found.measures.is_completed
    assert found.measures.interventions == 0
    assert found.measures.attempts == 2
    assert found.measures.reactions["hammering"] < 0.5
    hammered_s, cleared_s = found.reported[0][0], found.reported[-1][0]
    between = (found.trace.times > hammered_s) & (found.trace.times < cleared_s)
    table = found.parameters.height + ArmParameters().block_half
    assert found.trace.columns["height"][between].max() > table + 0.02
    without = episode(ExperimentArm.NONE, Table.HIGH).measures
    assert found.measures.time_above_30_n < 0.25 * without.time_above_30_n


def test_the_second_attempt_is_gentle_because_the_arm_is_soft() -> None:
    found = episode(ExperimentArm.ROSSMARIE, Table.HIGH)
    retried = found.trace.times > found.reported[-1][0]
    assert found.trace.columns["force"][retried].max() < 0.26 * found.measures.peak_force


@pytest.mark.deep
def test_with_rules_that_stop_it_waits_for_its_operator() -> None:
    found = episode(ExperimentArm.DEROS, Table.HIGH).measures
    assert found.is_completed
    assert found.interventions == 1
    assert found.duration > 30.0


def test_a_planner_that_wants_too_much_asks_joints_for_it_on_each_way() -> None:
    found = episode(ExperimentArm.NONE, Table.HURRIED)
    assert found.measures.is_completed
    assert found.measures.peak_effort > 0.6
    is_over = found.trace.columns["effort"] > 0.6
    begins = found.trace.times[1:][is_over[1:] & ~is_over[:-1]]
    assert np.count_nonzero(np.diff(begins, prepend=-1.0) > 1.0) == 3


def test_with_rules_that_recover_the_first_torque_spike_is_cut_and_the_others_stay_away() -> None:
    found, without = (
        episode(arm, Table.HURRIED).measures
        for arm in (ExperimentArm.ROSSMARIE, ExperimentArm.NONE)
    )
    assert found.is_completed
    assert found.interventions == 0
    assert found.reactions["torque"] < 0.05
    assert found.peak_effort < without.peak_effort
    assert found.time_over_torque < 0.2 * without.time_over_torque
    assert found.attempts == 1, "the block is placed at the first attempt, as it would be"


@pytest.mark.deep
def test_with_rules_that_stop_an_operator_turns_a_hurried_arm_down() -> None:
    found = episode(ExperimentArm.DEROS, Table.HURRIED).measures
    assert found.is_completed
    assert found.interventions == 1
    assert found.duration > episode(ExperimentArm.ROSSMARIE, Table.HURRIED).measures.duration + 25


def test_the_arm_goes_where_it_is_reported_to() -> None:
    built = ArmParameters()
    arm = RobotArm(build_placing(TableParameters(), built), built)
    place = arm.grasp + np.array([0.05, -0.03, 0.02])
    for _ in range(200):
        arm.move(place)
        arm.settle(4)
    assert arm.grasp == pytest.approx(place, abs=0.002)
    assert arm.block == pytest.approx(arm.grasp, abs=0.002)


def test_an_admittance_gives_way_as_a_spring_does() -> None:
    spring = Admittance(np.zeros(3), stiffness=500.0)
    for _ in range(2000):
        place = spring.step(np.zeros(3), np.array([0.0, 0.0, 10.0]), 0.008)
    assert place == pytest.approx([0.0, 0.0, 10.0 / 500.0])
