"""Another way to the goal of a task, found by the planner from where the world is now."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType

import pytest
from py_trees.common import Status

from ezskiros.engine.events import Event, Happened
from ezskiros.engine.interruption import Afterwards, InterruptibleTask, Recovery
from ezskiros.learning.lessons import Cost
from ezskiros.planning.replanning import replanner, way
from ezskiros.session import NOWHERE
from ezskiros.skills.calls import SkillCall
from support.engine import Skills

SOURCE = """
class Drive(SkillDescription):
    def description(
        self,
        Robot: cora.Robot,
        From: INFERRED[skiros.Location],
        To: skiros.Location,
        Speed: float = 0.5,
    ):
        self.pre_conditions += Robot.at(From)
        self.pre_conditions += From.spatiallyRelated(To)
        self.post_conditions += ~Robot.at(From)
        self.post_conditions += Robot.at(To)


class drive(Drive.SkillBase):
    def execute(self):
        self.world.relate(self.params.Robot, skiros.at, self.params.To)
        return self.success("there")


class Deliver(SkillDescription):
    def description(self, Robot: cora.Robot, Place: skiros.Location, Speed: float):
        self.post_conditions += Robot.at(Place)


class deliver(Deliver.SkillBase):
    def execute(self):
        return self.step("on the way")


class Block(SkillDescription):
    def description(self, One: skiros.Location, Other: skiros.Location):
        self.post_conditions += ~One.spatiallyRelated(Other)


class block(Block.SkillBase):
    def execute(self):
        self.world.unrelate(self.params.One, skiros.spatiallyRelated, self.params.Other)
        return self.success("blocked")
"""

SCENE = """
cora:Robot-1 a cora:Robot ; rdfs:label "heron" ; skiros:at skiros:Location-2 .
skiros:Location-2 a skiros:Location ; rdfs:label "dock" ;
    skiros:spatiallyRelated skiros:Location-3 , skiros:Location-4 .
skiros:Location-3 a skiros:Location ; rdfs:label "corridor" ;
    skiros:spatiallyRelated skiros:Location-5 .
skiros:Location-4 a skiros:Location ; rdfs:label "yard" ;
    skiros:spatiallyRelated skiros:Location-5 .
skiros:Location-5 a skiros:Location ; rdfs:label "hall" .
"""


@dataclass
class Robot:
    """A task, and what has come of it."""

    task: InterruptibleTask
    events: list[Event]
    told: list[tuple[bool, str]] = field(default_factory=list)

    def block(self, one: str, other: str) -> None:
        """A tree marks a way as blocked; then another is looked for."""
        library, world = self.task.setting.library, self.task.setting.world_model
        found = {each.__name__: each for each in library.descriptions()}
        things = {"One": world.thing(one), "Other": world.thing(other)}
        call = SkillCall(found["Block"], None, MappingProxyType(things), NOWHERE)
        self.task.recover(Recovery(call, Afterwards.REPLAN, lambda *end: self.told.append(end)))

    def to_the_end(self) -> Status:
        status, end = Status.RUNNING, time.monotonic() + 60
        while status is Status.RUNNING and time.monotonic() < end:
            status = self.task.tick()
            time.sleep(0.01)
        return status

    def ways(self) -> list[str]:
        """The ways that were driven, each with its speed."""
        return [
            "{From.label} to {To.label} at {Speed}".format(**each.values)
            for each in self.events
            if each.skill == "Drive" and each.happened is Happened.STARTED
        ]


def begun(folder: Path, skill: str, *texts: str, source: str = SOURCE) -> Robot:
    plain, events, _ = Skills(folder, source, SCENE).task(skill, *texts)
    setting = plain.setting
    task = InterruptibleTask(plain.root.call, setting, replanner(setting.library, setting.world))
    return Robot(task, events)


def test_a_way_around_what_a_tree_found_blocked(tmp_path: Path) -> None:
    robot = begun(tmp_path, "Deliver", "Robot=heron", "Place=hall", "Speed=0.3")
    robot.task.tick()
    robot.block("corridor", "hall")
    assert robot.to_the_end() is Status.SUCCESS
    assert robot.told == [(True, "")]
    assert robot.ways() == ["dock to yard at 0.3", "yard to hall at 0.3"]


def test_no_way_is_left(tmp_path: Path) -> None:
    robot = begun(tmp_path, "Deliver", "Robot=heron", "Place=hall", "Speed=0.3")
    robot.task.tick()
    world = robot.task.setting.world_model
    world.unrelate(world.thing("corridor"), "skiros:spatiallyRelated", world.thing("hall"))
    robot.block("yard", "hall")
    assert robot.to_the_end() is Status.FAILURE
    ((is_done, why),) = robot.told
    assert not is_done
    assert why.startswith("no plan leads to the goal of the task: no skill leads to this: ")
    assert "Robot-1 skiros:at skiros:Location-5" in why


@pytest.mark.parametrize(
    ("was", "becomes", "why"),
    [
        (
            "self.post_conditions += Robot.at(Place)",
            "self.pre_conditions += Robot.at(Place) | ~Robot.at(Place)",
            "`Deliver` has no post-condition: nobody knows its goal",
        ),
        (
            "self.post_conditions += Robot.at(Place)",
            "self.post_conditions += Robot.at(Place) | ~Robot.at(Place)",
            "a post-condition of `Deliver` is none that a plan can lead to",
        ),
        ("Speed: float = 0.5,", "Way: str,", "`Drive` needs a value for `Way`"),
    ],
)
def test_a_task_that_cannot_be_planned_says_why(
    tmp_path: Path, was: str, becomes: str, why: str
) -> None:
    assert was in SOURCE
    source = SOURCE.replace(was, becomes)
    robot = begun(tmp_path, "Deliver", "Robot=heron", "Place=hall", "Speed=0.3", source=source)
    robot.task.tick()
    robot.block("corridor", "hall")
    assert robot.to_the_end() is Status.FAILURE
    assert robot.told == [(False, f"no plan leads to the goal of the task: {why}")]


def test_the_search_changes_nothing_in_the_world(tmp_path: Path) -> None:
    robot = begun(tmp_path, "Deliver", "Robot=heron", "Place=hall", "Speed=0.3")
    setting, task = robot.task.setting, robot.task.root.call
    setting.world.save(tmp_path / "before.turtle")
    assert len(replanner(setting.library, setting.world)(task).result(60)) == 2
    setting.world.save(tmp_path / "after.turtle")
    assert (tmp_path / "before.turtle").read_text() == (tmp_path / "after.turtle").read_text()


def test_the_way_heeds_what_skills_lose_to_rules(tmp_path: Path) -> None:
    """The ways by the corridor and by the yard have the same length."""
    robot = begun(tmp_path, "Deliver", "Robot=heron", "Place=hall", "Speed=0.3")
    setting, task = robot.task.setting, robot.task.root.call

    def by(*costs: Cost) -> object:
        found = way(setting.library, task, setting.world, setting.world.copy(), costs)
        return found[0].arguments["To"].label  # type: ignore[attr-defined]

    def cost(start: str, target: str) -> Cost:
        things = {"From": setting.world_model.thing(start), "To": setting.world_model.thing(target)}
        places = tuple((name, thing.iri) for name, thing in things.items())
        return Cost("Drive", places, executions=2, activations=1, lost_s=9.0)

    assert by(cost("corridor", "hall")) == "yard"
    assert by(cost("yard", "hall")) == "corridor"
