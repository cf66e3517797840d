"""A rule runs a behavior tree, and the planner makes no way of what other rules always stop."""

from __future__ import annotations

from pathlib import Path

import pytest

from rossmarie.driver import compile_file
from support.backing_off import said
from support.engine import PREFIXES
from support.live import LIMIT, Ears, Process, Ros, until
from support.tasks_in_ros import begun_task, export

ROOT = Path(__file__).parents[2]
SKILLS = """
import os
import time
from pathlib import Path

from ezskiros import INFERRED, SkillDescription, topic
from ezskiros.ontology import load

world = load(Path(__file__).parent / "ontology")
cora, skiros = world.cora, world.skiros


def note(*words):
    with open(os.environ["NOTES"], "a") as notes:
        print(*words, time.time(), file=notes)


class Drive(SkillDescription):
    def description(self, Robot: cora.Robot, From: INFERRED[skiros.Location], To: skiros.Location):
        self.pre_conditions += Robot.at(From)
        self.pre_conditions += From.spatiallyRelated(To)
        self.post_conditions += ~Robot.at(From)
        self.post_conditions += Robot.at(To)
        self.uses += topic("/cmd_vel", "geometry_msgs/Twist")


class drive(Drive.SkillBase):
    def execute(self):
        note("drive to", self.params.To.label)
        self.world.relate(self.params.Robot, skiros.at, self.params.To)
        return self.success("there")


class Deliver(SkillDescription):
    def description(self, Robot: cora.Robot, Place: skiros.Location):
        self.post_conditions += Robot.at(Place)


class deliver(Deliver.SkillBase):
    def onStart(self):
        note("deliver")
        return True

    def execute(self):
        return self.step("on the way")


class Rest(SkillDescription):
    def description(self):
        pass


class rest(Rest.SkillBase):
    def execute(self):
        note("rest")
        return self.success("rested")
"""
SCENE = f"""{PREFIXES}
cora:Robot-1 a cora:Robot ; rdfs:label "heron" ; skiros:at skiros:Location-2 .
skiros:Location-2 a skiros:Location ; rdfs:label "dock" ;
    skiros:spatiallyRelated skiros:Location-3 , skiros:Location-4 .
skiros:Location-3 a skiros:Container ; rdfs:label "corridor" ;
    skiros:spatiallyRelated skiros:Location-5 .
skiros:Location-4 a skiros:Location ; rdfs:label "yard" ;
    skiros:spatiallyRelated skiros:Location-5 .
skiros:Location-5 a skiros:Location ; rdfs:label "hall" .
"""
CLOSED = SCENE.replace("Location-4 a skiros:Location", "Location-4 a skiros:Container")
"""A scene without a way that rules let the robot take."""
RULES = """
skills "skills.json";
input force = topic /force : std_msgs/Float64 in N timeout 3 sec;
action halt { block /cmd_vel : geometry_msgs/Twist; }
action anew { tree Rest within 20 sec then replan else halt; }
rule keep_out: if ahead Drive(To: Container) or doing Drive(To: Container) then { halt; };
rule stuck: if force > 5 N then { anew; };
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a robot that drives, and of the rules."""
    folder = tmp_path_factory.mktemp("replanning")
    export(folder, SKILLS, SCENE)
    (folder / "closed.turtle").write_text(CLOSED, encoding="utf-8")
    (folder / "driven.ross").write_text(RULES, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def program(ros: Ros, folder: Path) -> Path:
    """The node of the rules."""
    machine = compile_file(folder / "driven.ross").machine
    return ros.prepare([ROOT / "ros" / ros.name / "skill_context_msgs", machine])[1]


@pytest.mark.parametrize(
    ("scene", "code", "noted"),
    [
        ("lab.turtle", 0, ["deliver", "rest", "drive to yard", "drive to hall"]),
        ("closed.turtle", 1, ["deliver", "rest"]),
    ],
)
def test_no_way_is_made_of_what_rules_always_stop(
    ros: Ros,
    program: Path,
    folder: Path,
    tmp_path: Path,
    started: list[Process],
    scene: str,
    code: int,
    noted: list[str],
) -> None:
    notes, words = tmp_path / "notes", ("Deliver", "Robot=heron", "Place=hall")
    task = begun_task(ros, folder, words, notes, tmp_path / "run.log", scene=scene)
    started.append(task)
    until(lambda: said(notes) == ["deliver"], "the task runs")
    started.append(ros.begin(program, {"patience": LIMIT}))
    robot: Ears = ros.ears("/driven_safety/state", "driven_safety/State", script="forceful.py")
    started.append(robot)
    robot.set(force=20.0)
    assert task.running.wait(LIMIT) == code, task.said()
    assert said(notes) == noted
    steps = (f"`Drive(To = skiros:Location-{number})`" for number in (3, 4))
    forbidden = "the rules forbid " + " and ".join(steps)
    assert (forbidden in task.said()) is (code == 1)
