"""Experiment III: what the thesis says of a human in the room, in physics."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from support.parts import MUJOCO, require

require(MUJOCO)

from heron import messages
from heron.experiments import HumanEpisode, run_human
from heron.experiments.arms import HUMAN_RULES, machine_of
from heron.experiments.visitor import varied
from heron.guard import InProcessGuard
from heron.robot.arm_controller import SPEED_SCALE
from heron.scene import RoomParameters
from heron.tasks import Status
from heron.topics import SCAN, InProcess, NodeParameter
from heron.variants import ExperimentArm, Person

SEED = 3


@cache
def episode(arm: ExperimentArm, person: Person) -> HumanEpisode:
    """Each is run once for all tests."""
    return run_human(arm, person, SEED)


def during(found: HumanEpisode, begin: str, end: str, column: str) -> np.ndarray:
    """A column from when something was told to when something else was."""
    instants = {words.partition(":")[0]: at_s for at_s, words in found.reported}
    times = found.trace.times
    return found.trace.columns[column][(times > instants[begin]) & (times < instants[end])]


@pytest.mark.deep
def test_the_same_seed_is_the_same_episode() -> None:
    first = episode(ExperimentArm.ROSSMARIE, Person.INSIDE)
    again = run_human(ExperimentArm.ROSSMARIE, Person.INSIDE, SEED)
    assert (first.measures, first.reported, first.walk) == (
        again.measures,
        again.reported,
        again.walk,
    )
    assert np.array_equal(first.trace.columns["x"], again.trace.columns["x"])


def test_another_seed_is_another_walk() -> None:
    one, other = (varied(Person.INSIDE, np.random.default_rng(seed)) for seed in (1, 2))
    assert one != other
    assert one == varied(Person.INSIDE, np.random.default_rng(1))


def test_whoever_passes_the_open_door_restricts_nothing() -> None:
    found = episode(ExperimentArm.ROSSMARIE, Person.OUTSIDE)
    assert found.measures.is_completed
    assert found.reported == ()
    assert found.measures.time_restricted == 0.0
    assert not np.any(found.trace.columns["is_inside"])


def test_without_a_monitor_it_goes_on_at_full_speed_beside_a_person() -> None:
    found = episode(ExperimentArm.NONE, Person.INSIDE).measures
    assert found.is_completed
    assert found.fastest_near > 0.45
    assert found.time_too_fast > 2.0


def test_with_rules_that_recover_it_slows_gives_way_and_goes_on() -> None:
    found = episode(ExperimentArm.ROSSMARIE, Person.INSIDE)
    without = episode(ExperimentArm.NONE, Person.INSIDE).measures
    assert found.measures.is_completed
    assert found.measures.interventions == 0
    assert found.measures.risk < 0.1 * without.risk
    assert found.measures.fastest_near < 0.03, "it stands still before they are within its reach"
    assert found.measures.time_too_fast == 0.0
    assert found.measures.time_restricted_without_need == 0.0
    slow = during(found, "slow_when_entered activated", "stop_when_close activated", "speed")
    assert 0.15 < slow[200:].max() < 0.27
    still = during(found, "stop_when_close activated", "yield_when_beside activated", "speed")
    assert still[150:].max() < 0.02
    cleared_s = found.reported[-1][0]
    later = found.trace.columns["speed"][found.trace.times > cleared_s]
    assert later.max() > 0.45, "with the speed that it had before"


def test_its_task_is_a_tree_of_skills_and_what_became_of_them_is_known() -> None:
    root, *skills = episode(ExperimentArm.ROSSMARIE, Person.INSIDE).tree
    assert (root.label, root.depth) == ("carry_to_and_fro", 0)
    assert [skill.label for skill in skills[:2]] == ["Reach(here)", "Reach(above_here)"]
    spans = [skill.spans[0] for skill in skills]
    assert len(spans) == 24
    assert {span.status for span in (*root.spans, *spans)} == {Status.SUCCEEDED}
    ends = [span.end for span in spans if span.end is not None]
    assert root.spans[0].end == ends[-1]
    assert max(np.diff(ends)) > 8, "while somebody is close it waits"


def test_a_gravity_free_arm_gives_way_to_who_leads_it() -> None:
    instants = ("yield_when_beside activated", "yield_when_beside cleared")
    free = during(episode(ExperimentArm.ROSSMARIE, Person.INSIDE), *instants, "y")
    assert np.ptp(free) > 0.05
    assert free[-1] == pytest.approx(free[-500], abs=0.01), "it stays where it was led to"


@pytest.mark.parametrize(("beyond", "is_close"), [(0.02, False), (-0.02, True)])
def test_close_is_as_near_as_the_rules_say(beyond: float, is_close: bool) -> None:
    ranges = np.full(720, np.inf, dtype=np.float32)
    ranges[:10] = RoomParameters().close + beyond
    carrier = InProcess()
    carrier.declare(SPEED_SCALE, NodeParameter(lambda: 1.0, lambda _: None))
    guard = InProcessGuard(machine_of(HUMAN_RULES[ExperimentArm.ROSSMARIE]), carrier, lambda: 0)
    scan = messages.laser_scan(0, (-np.pi, np.pi, np.radians(0.5)), (0.1, 30.0), ranges)
    carrier.publisher(SCAN)(scan)
    assert ("stop_when_close" in guard.active) == is_close
    assert "slow_when_entered" in guard.active


@pytest.mark.deep
def test_it_reacts_as_soon_as_a_scan_shows_it() -> None:
    for arm in (ExperimentArm.DEROS, ExperimentArm.ROSSMARIE):
        found = episode(arm, Person.INSIDE).measures.reactions
        assert 0.1 < found["entered"] < 0.8, "the door lies 0.2 m before what counts as the room"
    assert 0.1 < episode(ExperimentArm.ROSSMARIE, Person.INSIDE).measures.reactions["close"] < 0.3


def test_with_rules_that_stop_it_waits_for_its_operator() -> None:
    found = episode(ExperimentArm.DEROS, Person.INSIDE)
    assert found.measures.is_completed
    assert found.measures.interventions == 1
    assert (
        found.measures.duration
        > episode(ExperimentArm.ROSSMARIE, Person.INSIDE).measures.duration + 10
    )
    assert found.measures.time_too_fast == 0.0
    assert found.measures.time_restricted_without_need > 10, "nobody is there any more"
