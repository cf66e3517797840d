"""A rule runs a behavior tree in the place of the task that `ezskiros run` runs."""

from __future__ import annotations

import shutil
import signal
from collections.abc import Callable
from pathlib import Path

import pytest

from support import command_line
from support.backing_off import BEGUN, SKILLS, active, rules, said, tasks
from support.live import LIMIT, Ears, Process, Ros, until
from support.live_runs import begun_run
from support.ontologies import HALL

ROOT = Path(__file__).parents[2]
PUSH, PULL = 20.0, -20.0
"""Forces (N): a short tree answers the first, one that ends with its rule the second."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a robot: its ontology and scene, its skills, and their export."""
    folder = tmp_path_factory.mktemp("backing_off")
    shutil.copytree(HALL, folder / "ontology")
    shutil.copy(HALL.parent / "lab.turtle", folder)
    (folder / "skills.py").write_text(SKILLS.format(up=0), encoding="utf-8")
    exported = ("skills.py", "lab.turtle", "--ontology", "ontology", "-o", "skills.json")
    done = command_line.run("ezskiros", "export", *exported, folder=folder)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


@pytest.fixture(scope="module")
def program(ros: Ros, folder: Path) -> Path:
    """The node of the rules, which need the export."""
    return ros.prepare([ROOT / "ros" / ros.name / "skill_context_msgs", rules(folder)])[1]


@pytest.fixture
def notes(tmp_path: Path) -> Path:
    """The notes of the skills that run."""
    return tmp_path / "notes"


Begin = Callable[[Path, str], Process]


@pytest.fixture
def task(begin: Begin, notes: Path) -> Process:
    """A task that runs, and a guard beside it."""
    return begin(notes, "")


@pytest.fixture
def begin(ros: Ros, program: Path, folder: Path, tmp_path: Path, started: list[Process]) -> Begin:
    """Starts a task and its guard in a namespace; its skills note what they do."""

    def begun(notes: Path, namespace: str) -> Process:
        task = begun_task(ros, folder, notes, tmp_path, namespace)
        started.append(task)
        until(lambda: said(notes) == BEGUN[:1], "the task runs")
        started.append(ros.begin(program, {"patience": LIMIT}, namespace=namespace))
        return task

    return begun


def begun_task(ros: Ros, folder: Path, notes: Path, tmp_path: Path, namespace: str) -> Process:
    words = ("Push", str(folder), "Object=cable", "--scene", str(folder / "lab.turtle"))
    options = ("--context", str(folder / "skills.json"), "--ontology", str(folder / "ontology"))
    log = tmp_path / f"run{namespace[1:]}.log"
    return begun_run(ros, (*words, *options), log, notes, namespace)


@pytest.fixture
def robot(ros: Ros, started: list[Process]) -> Ears:
    """Feels a force, and hears of the rules."""
    robot = ros.ears("/stuck_safety/state", "stuck_safety/State", script="forceful.py")
    started.append(robot)
    return robot


def becomes(notes: Path, wanted: list[str]) -> None:
    until(lambda: said(notes) == wanted, f"the skills note {wanted}")


@pytest.mark.usefixtures("task")
def test_the_tree_of_a_rule_runs_and_the_task_resumes(notes: Path, robot: Ears) -> None:
    robot.set(force=PUSH)
    becomes(notes, [*BEGUN, "push cable"])
    assert active(robot) == ["stuck"]
    until(lambda: tasks(robot)["away"] == "done", f"{tasks(robot)}")


@pytest.mark.usefixtures("task")
def test_the_tree_stops_when_the_rule_is_released(notes: Path, robot: Ears) -> None:
    robot.set(force=PULL)
    becomes(notes, BEGUN)
    robot.set(force=0.0)
    becomes(notes, [*BEGUN, "released", "push cable"])
    until(lambda: active(robot) == [], "the rule is released")


@pytest.mark.usefixtures("task")
def test_the_tree_of_another_rule_takes_its_place(notes: Path, robot: Ears) -> None:
    """The node cancels the one and asks for the other at once, in whichever order they come."""
    robot.set(force=PULL)
    becomes(notes, BEGUN)
    robot.set(force=PUSH)
    becomes(notes, [*BEGUN, "released", "back_off cable", "push cable"])
    until(lambda: tasks(robot)["away"] == "done", f"{tasks(robot)}")


@pytest.mark.parametrize(
    ("how", "code", "noted"),
    [(signal.SIGINT, 1, [*BEGUN, "released"]), (signal.SIGTERM, 128 + signal.SIGTERM, BEGUN)],
)
def test_a_task_that_is_stopped_meanwhile_ends(
    task: Process, notes: Path, robot: Ears, how: int, code: int, noted: list[str]
) -> None:
    robot.set(force=PULL)
    becomes(notes, BEGUN)
    task.running.send_signal(how)
    assert task.running.wait(LIMIT) == code, task.said()
    # At its end rospy may tell of what its own thread still wanted to do.
    assert "ezskiros/" not in task.said().partition("Traceback")[2], task.said()
    assert said(notes) == noted


def test_a_robot_hears_its_own_rules_only(
    ros: Ros, begin: Begin, tmp_path: Path, started: list[Process]
) -> None:
    first, second = tmp_path / "first", tmp_path / "second"
    begin(first, "/robot1")
    begin(second, "/robot2")
    robots = [
        ros.ears(f"/{name}/stuck_safety/state", "stuck_safety/State", script="forceful.py")
        for name in ("robot1", "robot2")
    ]
    started.extend(robots)
    for each in robots:
        each.set(force=0.0)
    robots[0].set(force=PUSH)
    becomes(first, [*BEGUN, "push cable"])
    assert said(second) == BEGUN[:1]
    robots[1].set(force=PULL)
    becomes(second, BEGUN)
    assert said(first) == [*BEGUN, "push cable"]
