"""Skills wait while rules take away what they use: `crosscheck weave`, and `ezskiros run --guards`
beside the node of the rules.
"""

from __future__ import annotations

import signal
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from ezskiros.context.guards import PATIENCE
from rossmarie.driver import compile_file
from support import command_line
from support.backing_off import said
from support.live import LIMIT, Ears, Process, Ros, until
from support.tasks_in_ros import begun_run

ROOT = Path(__file__).parents[2]
NODE = "driving_safety"
SKILLS = """
import os
from pathlib import Path

from ezskiros import SkillDescription, topic


def note(word):
    with open(os.environ["NOTES"], "a") as notes:
        print(word, "now", file=notes)


class Stand(SkillDescription):
    def description(self):
        pass


class stand(Stand.SkillBase):
    def execute(self):
        there = Path(os.environ["NOTES"] + ".go").exists()
        return self.success("stood") if there else self.step("standing")


class Drive(SkillDescription):
    def description(self):
        self.uses += topic("/cmd_vel", "geometry_msgs/Twist")


class drive(Drive.SkillBase):
    def __init__(self):
        super().__init__()
        note("init")

    def onStart(self):
        note("drive")
        self.left = 5
        return True

    def execute(self):
        self.left -= 1
        return self.step("driving") if self.left else self.success("there")

    def onPreempt(self):
        note("preempt")
        return self.fail("stopped", -1)


class Trip(SkillDescription):
    def description(self):
        pass


class trip(Trip.SkillBase):
    def expandBT(self, params):
        self.serialstar(Stand(), Drive())
"""
RULES = """
skills "skills.json";
input force = topic /force : std_msgs/Float64 in N timeout 3 sec;
action halt { block /cmd_vel : geometry_msgs/Twist; }
rule stop: if force > 5 N then { halt; };
"""
UNKNOWN = "waits: the active rules are unknown"
ACTIVE = "waits: rule `stop` is active"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a robot: its skills, their export, its rules and its guards."""
    folder = tmp_path_factory.mktemp("driving")
    (folder / "skills.py").write_text(SKILLS, encoding="utf-8")
    (folder / "driving.ross").write_text(RULES, encoding="utf-8")
    for words in (
        ("ezskiros", "export", "skills.py", "-o", "skills.json"),
        ("crosscheck", "weave", "driving.ross", "-o", "guards.json"),
    ):
        done = command_line.run(*words, folder=folder)
        assert done.returncode == 0, done.stdout + done.stderr
    return folder


@pytest.fixture(scope="module")
def program(ros: Ros, folder: Path) -> Path:
    """The node of the rules."""
    messages = ROOT / "ros" / ros.name / "skill_context_msgs"
    return ros.prepare([messages, compile_file(folder / "driving.ross").machine])[1]


@pytest.fixture
def notes(tmp_path: Path) -> Path:
    """The notes of the skills that run."""
    return tmp_path / "notes"


Start = Callable[[], Process]


@pytest.fixture
def node(ros: Ros, program: Path, started: list[Process]) -> Start:
    """Starts the node of the rules."""

    def begin() -> Process:
        found = ros.begin(program, {"patience": LIMIT}, namespace="/robot1")
        started.append(found)
        return found

    return begin


@pytest.fixture
def task(ros: Ros, folder: Path, notes: Path, tmp_path: Path, started: list[Process]) -> Start:
    """Starts a trip."""

    def begin() -> Process:
        words = ("Trip", str(folder), "--guards", str(folder / "guards.json"))
        found = begun_run(ros, words, tmp_path / "run.log", notes, "/robot1")
        started.append(found)
        return found

    return begin


@pytest.fixture
def robot(ros: Ros, started: list[Process]) -> Ears:
    """Feels a force, and hears of the rules."""
    topic = f"/robot1/{NODE}/state"
    robot = ros.ears(topic, f"{NODE}/State", script="forceful.py")
    started.append(robot)
    return robot


def go(notes: Path) -> None:
    """Let the trip begin to drive."""
    Path(f"{notes}.go").touch()


def becomes(robot: Ears, rules: list[str]) -> None:
    topic = f"/robot1/{NODE}/state"

    def is_so() -> bool:
        reported = robot.last(topic) or {}
        return bool(reported.get("open")) and reported["active"] == rules

    until(is_so, f"{rules} are active, not {robot.last(topic)}")


def says(task: Process, what: str) -> None:
    until(lambda: what in task.said(), f"{what}, not {task.said()}")


def succeeds(task: Process) -> None:
    assert task.running.wait(LIMIT) == 0, task.said()


def test_a_skill_waits_while_a_rule_is_active_and_then_starts(
    robot: Ears, node: Start, task: Start, notes: Path
) -> None:
    robot.set(force=20.0)
    node()
    becomes(robot, ["stop"])
    go(notes)
    trip = task()
    says(trip, ACTIVE)
    assert said(notes) == []
    robot.set(force=0.0)
    succeeds(trip)
    assert said(notes) == ["init", "drive"]
    assert "nothing was run" not in trip.said()


def test_a_skill_starts_while_no_rule_is_active(
    robot: Ears, node: Start, task: Start, notes: Path
) -> None:
    robot.set(force=0.0)
    node()
    becomes(robot, [])
    trip = task()
    says(trip, "standing")
    go(notes)
    succeeds(trip)
    assert said(notes) == ["init", "drive"]
    assert ACTIVE not in trip.said()


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGSTOP], ids=["killed", "stopped"])
def test_a_skill_waits_while_nobody_knows(
    ros: Ros, robot: Ears, node: Start, task: Start, notes: Path, how: int
) -> None:
    robot.set(force=0.0)
    stale = node()
    becomes(robot, [])
    trip = task()
    says(trip, "standing")
    if how == signal.SIGKILL:
        stale.end()
    else:
        stale.running.send_signal(how)
    is_noticed_at_once = how == signal.SIGKILL and ros.name == "ros1"
    time.sleep(1.0 if is_noticed_at_once else PATIENCE + 1.0)
    go(notes)
    says(trip, UNKNOWN)
    assert said(notes) == []
    if how == signal.SIGKILL:
        node()
    else:
        stale.running.send_signal(signal.SIGCONT)
    succeeds(trip)
    assert said(notes) == ["init", "drive"]


def test_a_trip_that_is_stopped_while_it_waits_ends_at_once(task: Start, notes: Path) -> None:
    go(notes)
    trip = task()
    says(trip, UNKNOWN)
    trip.running.send_signal(signal.SIGINT)
    assert trip.running.wait(LIMIT) == 1, trip.said()
    assert "Traceback" not in trip.said()
    assert said(notes) == []
