"""A rule runs a behavior tree in the place of the task that `ezskiros run` runs."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

import pytest

from support import command_line
from support.backing_off import BEGUN, SKILLS, active, rules, said, tasks
from support.live import LIMIT, Ears, Process, talking, until
from support.ontologies import HALL
from support.ros1_live import Ros1

ROOT = Path(__file__).parents[3]
MESSAGES = ROOT / "ros" / "ros1" / "skill_context_msgs"
START = """
import sys

sys.path.append("/usr/lib/python3/dist-packages")

from ezskiros.cli.main import main

main()
"""
"""The packages of ROS 1 come last: those of the project are newer."""


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a robot: its ontology and scene, its skills, and their export."""
    folder = tmp_path_factory.mktemp("backing_off")
    shutil.copytree(HALL, folder / "ontology")
    shutil.copy(HALL.parent / "lab.turtle", folder)
    (folder / "skills.py").write_text(SKILLS.format(up=0), encoding="utf-8")
    exported = ("skills.py", "lab.turtle", "--ontology", "ontology", "-o", "skills.json")
    done = command_line.run("ezskiros", "export", *exported, folder=folder)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


@pytest.fixture
def notes(ros1: Ros1, robot: Path, tmp_path: Path, started: list[Process]) -> Path:
    """The notes of the skills that run: a task and a guard have started."""
    _, program = ros1.prepare([MESSAGES, rules(robot)])
    notes = tmp_path / "notes"
    places = [ros1.variables["PYTHONPATH"], os.environ.get("PYTHONPATH", "")]
    paths = ":".join(filter(None, places))
    variables = {**ros1.variables, "PYTHONPATH": paths, "NOTES": str(notes)}
    words = ("run", "Push", str(robot), "Object=cable", "--scene", str(robot / "lab.turtle"))
    options = ("--context", str(robot / "skills.json"), "--ontology", str(robot / "ontology"))
    command = [sys.executable, "-c", START, *words, *options]
    started.append(Process(command, variables, tmp_path / "run.log", talking))
    until(lambda: said(notes) == BEGUN[:1], "the task runs")
    started.append(ros1.begin(program, {"patience": LIMIT}))
    return notes


@pytest.fixture
def state(ros1: Ros1, started: list[Process]) -> Ears:
    ears = ros1.ears("/stuck_safety/state", "stuck_safety/State")
    started.append(ears)
    return ears


def feel(ros1: Ros1, newton: float, started: list[Process]) -> Process:
    sensor = ros1.publish(20, "/force", "std_msgs/Float64", f"data: {newton}")
    started.append(sensor)
    return sensor


def test_the_tree_of_a_rule_runs_and_the_task_resumes(
    ros1: Ros1, notes: Path, state: Ears, started: list[Process]
) -> None:
    feel(ros1, 20.0, started)
    until(lambda: said(notes) == [*BEGUN, "push cable"], f"{said(notes)}")
    assert active(state) == ["stuck"]
    until(lambda: tasks(state)["away"] == "done", f"{tasks(state)}")


def test_the_tree_stops_when_the_rule_is_released(
    ros1: Ros1, notes: Path, state: Ears, started: list[Process]
) -> None:
    sensor = feel(ros1, -20.0, started)
    until(lambda: said(notes) == BEGUN, f"{said(notes)}")
    sensor.end()
    feel(ros1, 0.0, started)
    until(lambda: said(notes) == [*BEGUN, "released", "push cable"], f"{said(notes)}")
    until(lambda: active(state) == [], "the rule is released")
