"""A rule runs a behavior tree in real SkiROS2, in the place of the task of its skill manager."""

from __future__ import annotations

from pathlib import Path

import pytest

from support.backing_off import BEGUN, active, hosted, rules, said, tasks
from support.live import LIMIT, Ears, Process, until
from support.parts import SKIROS2, needs
from support.ros1_live import Ros1
from support.skiros2_live import Robot, SkiROS2

ROOT = Path(__file__).parents[3]
MESSAGES = ROOT / "ros" / "ros1" / "skill_context_msgs"
pytestmark = [needs(SKIROS2)]


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Robot:
    return hosted(tmp_path_factory.mktemp("backing_off"))


@pytest.fixture
def notes(ros1: Ros1, robot: Robot, tmp_path: Path, started: list[Process]) -> Path:
    """The notes of the skills that run: a task and a guard have started."""
    _, program = ros1.prepare([MESSAGES, rules(robot.workspace)])
    notes = tmp_path / "notes"
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("NOTES", str(notes))
        SkiROS2(ros1, robot, tmp_path, started)
    until(lambda: said(notes) == BEGUN[:1], f"the task runs: {said(notes)}")
    started.append(ros1.begin(program, {"patience": LIMIT}))
    return notes


@pytest.fixture
def sensor(ros1: Ros1, started: list[Process]) -> Ears:
    """Feels a force, and hears of the rules."""
    sensor = ros1.ears("/stuck_safety/state", "stuck_safety/State", script="forceful.py")
    started.append(sensor)
    return sensor


def test_the_tree_of_a_rule_runs_and_the_task_resumes(notes: Path, sensor: Ears) -> None:
    sensor.set(force=20.0)
    until(lambda: said(notes) == [*BEGUN, "push cable"], f"{said(notes)}")
    assert active(sensor) == ["stuck"]
    until(lambda: tasks(sensor)["away"] == "done", f"{tasks(sensor)}")


def test_the_tree_stops_when_the_rule_is_released(notes: Path, sensor: Ears) -> None:
    sensor.set(force=-20.0)
    until(lambda: said(notes) == BEGUN, f"{said(notes)}")
    sensor.set(force=0.0)
    until(lambda: said(notes) == [*BEGUN, "released", "push cable"], f"{said(notes)}")
    until(lambda: active(sensor) == [], "the rule is released")


def test_the_tree_of_another_rule_takes_its_place(notes: Path, sensor: Ears) -> None:
    sensor.set(force=-20.0)
    until(lambda: said(notes) == BEGUN, f"{said(notes)}")
    sensor.set(force=20.0)
    both = [*BEGUN, "released", "back_off cable", "push cable"]
    until(lambda: said(notes) == both, f"the skills note {both}")
    until(lambda: tasks(sensor)["away"] == "done", f"{tasks(sensor)}")
