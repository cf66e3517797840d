"""A rule runs a behavior tree in real SkiROS2, in the place of the task of its skill manager."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from ezskiros.hosts.owl_files import owl_files
from ezskiros.ontology import load
from support import command_line
from support.backing_off import BEGUN, SKILLS, active, rules, said, tasks
from support.live import LIMIT, Ears, Process, until
from support.ontologies import HALL
from support.parts import SKIROS2, needs
from support.ros1_live import Ros1
from support.skiros2_live import Robot, SkiROS2

ROOT = Path(__file__).parents[3]
MESSAGES = ROOT / "ros" / "ros1" / "skill_context_msgs"
HOST = 'from ezskiros.hosts.skiros2 import host\n\nhost(__name__, context="../skills.json")\n'

pytestmark = [needs(SKIROS2)]


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a robot: its ontology and scene, its library of skills, and their export."""
    folder = tmp_path_factory.mktemp("backing_off")
    shutil.copytree(HALL, folder / "ontology")
    shutil.copy(HALL.parent / "lab.turtle", folder)
    library = folder / "backing_skills"
    library.mkdir()
    (library / "__init__.py").write_text(HOST, encoding="utf-8")
    (library / "motions.py").write_text(SKILLS.format(up=1), encoding="utf-8")
    exported = ("backing_skills", "lab.turtle", "--ontology", "ontology", "-o", "skills.json")
    done = command_line.run("ezskiros", "export", *exported, folder=folder)
    assert done.returncode == 0, done.stdout + done.stderr
    files, found = owl_files(load(folder / "ontology", relations=False))
    assert found == []
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


@pytest.fixture
def notes(ros1: Ros1, robot: Path, tmp_path: Path, started: list[Process]) -> Path:
    """The notes of the skills that run: a task and a guard have started."""
    _, program = ros1.prepare([MESSAGES, rules(robot)])
    notes = tmp_path / "notes"
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("NOTES", str(notes))
        pushing = Robot(
            workspace=robot,
            scene="lab.turtle",
            library="backing_skills",
            skills=["push", "back_off"],
            begins=["push", "Object=cable"],
        )
        SkiROS2(ros1, pushing, tmp_path, started)
    until(lambda: said(notes) == BEGUN[:1], f"the task runs: {said(notes)}")
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


def test_the_tree_of_another_rule_takes_its_place(
    ros1: Ros1, notes: Path, state: Ears, started: list[Process]
) -> None:
    sensor = feel(ros1, -20.0, started)
    until(lambda: said(notes) == BEGUN, f"{said(notes)}")
    sensor.end()
    feel(ros1, 20.0, started)
    both = [*BEGUN, "released", "back_off cable", "push cable"]
    until(lambda: said(notes) == both, f"the skills note {both}")
    until(lambda: tasks(state)["away"] == "done", f"{tasks(state)}")
