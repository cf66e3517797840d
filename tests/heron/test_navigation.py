"""Experiment I: what the thesis says of its three arms, in physics."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from heron.experiments import NavigationEpisode, run_navigation
from heron.experiments.picking import Standing, pick_up
from heron.goals import NAVIGATE, Goal
from heron.robot import Base
from heron.scene import BaseParameters, CourseParameters, build_navigation, course
from heron.tasks import SkillTask, Status, TaskStatus
from heron.topics import InProcess
from heron.variants import ExperimentArm, Terrain

SEED = 3


@cache
def episode(arm: ExperimentArm, terrain: Terrain) -> NavigationEpisode:
    """Each is run once for all tests."""
    return run_navigation(arm, terrain, SEED)


@pytest.mark.deep
def test_the_same_seed_is_the_same_episode() -> None:
    first = episode(ExperimentArm.ROSSMARIE, Terrain.FLAT)
    again = run_navigation(ExperimentArm.ROSSMARIE, Terrain.FLAT, SEED)
    assert (first.measures, first.reported) == (again.measures, again.reported)
    assert all(
        np.array_equal(first.trace.columns[name], again.trace.columns[name])
        for name in first.trace.columns
    )


@pytest.mark.deep
def test_another_seed_is_another_episode() -> None:
    one = episode(ExperimentArm.ROSSMARIE, Terrain.FLAT)
    other = run_navigation(ExperimentArm.ROSSMARIE, Terrain.FLAT, SEED + 1)
    assert one.course != other.course
    assert not np.array_equal(one.trace.columns["y"][:5000], other.trace.columns["y"][:5000])


class Driver:
    """A base that is there as soon as a test says so."""

    def send(self, _: Goal, done: Callable[[bool], None]) -> None:
        self.done = done

    def cancel(self) -> None:
        raise AssertionError


@pytest.mark.parametrize(("aside", "is_held"), [(0.0, True), (0.6, False)])
def test_the_block_is_picked_up_from_where_the_base_stands(aside: float, is_held: bool) -> None:
    built = course(Terrain.FLAT, CourseParameters())
    base = Base(build_navigation(built, BaseParameters()))
    x, y = built.routes[0][-1]
    heading = np.arctan2(y, x - built.routes[0][-2][0])
    base.data.qpos[:2] = (x - aside, y + aside)
    base.data.qpos[3:7] = (np.cos(heading / 2), 0.0, 0.0, np.sin(heading / 2))
    carrier, driver = InProcess(), Driver()
    carrier.serve(NAVIGATE, driver)
    task = SkillTask(carrier, "Fetch", "navigation.turtle", ["Target=room"])
    base.now_ns = 1_000_000_000
    task.tick(base.now_ns)
    driver.done(True)
    generators = {name: np.random.default_rng(1) for name in ("picking", "joints")}
    picked = pick_up(Standing(base, [], None), built, task, generators, [])
    assert picked.is_held == is_held
    assert (task.outcome is TaskStatus.COMPLETED) == is_held


def test_on_level_ground_nothing_is_restricted() -> None:
    found = episode(ExperimentArm.ROSSMARIE, Terrain.FLAT)
    assert found.measures.is_completed
    assert found.reported == ()
    assert found.measures.time_restricted == 0.0


@pytest.mark.deep
def test_the_first_axle_hits_the_bump_and_the_others_are_spared() -> None:
    without = episode(ExperimentArm.NONE, Terrain.GENTLE).measures.peaks
    guarded = episode(ExperimentArm.ROSSMARIE, Terrain.GENTLE).measures.peaks
    assert guarded["front"] > 0.7 * without["front"], "the rule reacts, it does not foresee"
    assert guarded["drive"] < 0.6 * without["drive"]
    assert guarded["rear"] < 0.6 * without["rear"]


def test_without_a_monitor_the_base_stalls_on_the_gentle_ramp() -> None:
    found = episode(ExperimentArm.NONE, Terrain.GENTLE)
    assert found.outcome is TaskStatus.GIVEN_UP
    assert found.measures.time_over_torque > 30


def test_with_rules_that_recover_it_arrives_by_itself() -> None:
    found = episode(ExperimentArm.ROSSMARIE, Terrain.GENTLE).measures
    assert found.is_completed
    assert found.interventions == 0
    assert found.reactions["bump"] < 0.1
    assert found.reactions["gentle"] < 1.0


@pytest.mark.deep
def test_with_rules_that_stop_it_waits_for_its_operator() -> None:
    found = episode(ExperimentArm.DEROS, Terrain.GENTLE).measures
    recovered = episode(ExperimentArm.ROSSMARIE, Terrain.GENTLE).measures
    assert found.is_completed
    assert found.interventions == 2
    assert found.duration > recovered.duration + 60


@pytest.mark.deep
def test_from_a_steep_ramp_it_backs_off_and_takes_the_other_way() -> None:
    found = episode(ExperimentArm.ROSSMARIE, Terrain.STEEP)
    assert found.measures.is_completed
    assert found.measures.replanned == 1
    assert found.measures.reactions["steep"] < 2.5
    drive, grasp = (
        next(skill.spans[-1] for skill in found.tree if skill.label.startswith(name))
        for name in ("Drive", "Grasp")
    )
    assert drive.end is not None
    assert found.measures.duration > drive.end + 3, "it has picked up the block"
    assert grasp.status is Status.SUCCEEDED
    assert found.trace.times[-1] == pytest.approx(found.measures.duration, abs=0.01)
    assert found.measures.interventions == 0
    assert any("back_off_steep_ramp activated" in words for _, words in found.reported)
    assert found.trace.columns["y"].min() < -2.5
