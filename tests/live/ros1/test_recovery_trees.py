"""A rule runs a behavior tree in the place of the task that `ezskiros run` runs."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from rossmarie.driver import compile_file
from support import command_line
from support.live import LIMIT, Ears, Process, talking, until
from support.ontologies import HALL
from support.ros1_live import Ros1

ROOT = Path(__file__).parents[3]
MESSAGES = ROOT / "ros" / "ros1" / "skill_context_msgs"
PACKAGES = "/usr/lib/python3/dist-packages"
START = f"""
import sys

sys.path.append({PACKAGES!r})

from ezskiros.cli.main import main

main()
"""
"""The packages of ROS 1 come last: those of the project are newer."""

SKILLS = """
import os
import time
from pathlib import Path

from ezskiros import SkillDescription
from ezskiros.ontology import load

world = load(Path(__file__).parent / "ontology")


def note(*words):
    with open(os.environ["NOTES"], "a") as notes:
        print(*words, time.time(), file=notes)


class Push(SkillDescription):
    def description(self, Object: world.skiros.Product):
        pass


class push(Push.SkillBase):
    def onStart(self):
        note("push", self.params.Object.label)
        return True

    def execute(self):
        return self.step("pushing")

    def onPreempt(self):
        note("preempted")
        return self.fail("stopped", -1)


class BackOff(SkillDescription):
    def description(self, From: world.skiros.Product, Steps: int):
        pass


class back_off(BackOff.SkillBase):
    def onStart(self):
        self.left = self.params.Steps
        note("back_off", self.params.From.label)
        return True

    def execute(self):
        self.left -= 1
        return self.step("backing off") if self.left else self.success("backed off")

    def onPreempt(self):
        note("released")
        return self.fail("stopped", -1)
"""
RULES = """
skills "skills.json";
input force = topic /force : std_msgs/Float64 in N timeout 3 sec;
action halt { block /cmd_vel : geometry_msgs/Twist; }
action away {
    tree BackOff(From: doing Push.Object, Steps: 10) within 20 sec then resume else halt;
}
action far {
    tree BackOff(From: doing Push.Object, Steps: 10000) within 20 min then resume else halt;
}
rule stuck: if force > 5 N for 0.2 sec then { away; };
rule pulled: if force < -5 N for 0.2 sec then { far; };
priority stuck over pulled;
"""


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a robot: its ontology and scene, its skills, their export, and its rules."""
    folder = tmp_path_factory.mktemp("backing_off")
    shutil.copytree(HALL, folder / "ontology")
    shutil.copy(HALL.parent / "lab.turtle", folder)
    (folder / "skills.py").write_text(SKILLS, encoding="utf-8")
    (folder / "stuck.ross").write_text(RULES, encoding="utf-8")
    exported = ("skills.py", "lab.turtle", "--ontology", "ontology", "-o", "skills.json")
    done = command_line.run("ezskiros", "export", *exported, folder=folder)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


@pytest.fixture
def notes(ros1: Ros1, robot: Path, tmp_path: Path, started: list[Process]) -> Iterator[Path]:
    """The notes of the skills that run: a task and a guard have started."""
    _, program = ros1.prepare([MESSAGES, compile_file(robot / "stuck.ross").machine])
    notes = tmp_path / "notes"
    places = [ros1.variables["PYTHONPATH"], os.environ.get("PYTHONPATH", "")]
    variables = {
        **ros1.variables,
        "PYTHONPATH": ":".join(filter(None, places)),
        "NOTES": str(notes),
    }
    words = ("run", "Push", str(robot), "Object=cable", "--scene", str(robot / "lab.turtle"))
    options = ("--context", str(robot / "skills.json"), "--ontology", str(robot / "ontology"))
    command = [sys.executable, "-c", START, *words, *options]
    started.append(Process(command, variables, tmp_path / "run.log", talking))
    until(lambda: said(notes) == ["push cable"], "the task runs")
    started.append(ros1.begin(program, {"patience": LIMIT}))
    return notes


def said(notes: Path) -> list[str]:
    """The notes, without their times."""
    text = notes.read_text() if notes.is_file() else ""
    return [line.rpartition(" ")[0] for line in text.splitlines()]


def feel(ros1: Ros1, newton: float, started: list[Process]) -> Process:
    sensor = ros1.publish(20, "/force", "std_msgs/Float64", f"data: {newton}")
    started.append(sensor)
    return sensor


@pytest.fixture
def state(ros1: Ros1, started: list[Process]) -> Ears:
    ears = ros1.ears("/stuck_safety/state", "stuck_safety/State")
    started.append(ears)
    return ears


def active(state: Ears) -> list[str]:
    return list((state.last("/stuck_safety/state") or {}).get("active", ()))


def tasks(state: Ears) -> dict[str, str]:
    told = (state.last("/stuck_safety/state") or {}).get("tasks", ())
    return {task["action"]: task["state"] for task in told}


BEGUN = ["push cable", "preempted", "back_off cable"]


def test_the_tree_of_a_rule_runs_and_the_task_resumes(
    ros1: Ros1, notes: Path, state: Ears, started: list[Process]
) -> None:
    feel(ros1, 20.0, started)
    until(lambda: said(notes) == [*BEGUN, "push cable"], f"{said(notes)}")
    assert active(state) == ["stuck"]
    until(lambda: tasks(state) == {"away": "done"}, f"{tasks(state)}")


def test_the_tree_stops_when_the_rule_is_released(
    ros1: Ros1, notes: Path, state: Ears, started: list[Process]
) -> None:
    sensor = feel(ros1, -20.0, started)
    until(lambda: said(notes) == BEGUN, f"{said(notes)}")
    sensor.end()
    feel(ros1, 0.0, started)
    until(lambda: said(notes) == [*BEGUN, "released", "push cable"], f"{said(notes)}")
    until(lambda: active(state) == [], "the rule is released")
