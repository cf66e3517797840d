"""Another way to the goal of a task, found by the planner from where the world is now."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from py_trees.common import Status

from ezskiros.engine.events import Event, Happened
from ezskiros.engine.interruption import Afterwards, InterruptibleTask, Recovery
from ezskiros.engine.prohibitions import Prohibition
from ezskiros.engine.world import World
from ezskiros.learning.lessons import Cost
from ezskiros.ontology import Ontology
from ezskiros.ontology.iris import THING
from ezskiros.planning.actions import PlanningAction, actions
from ezskiros.planning.facts import About, Fluent, FluentLiteral
from ezskiros.planning.forbidden import permitted
from ezskiros.planning.reach import ReachableFacts
from ezskiros.planning.replanning import planned_calls, replanner
from ezskiros.session import NOWHERE
from ezskiros.skills.calls import SkillCall
from support.depth import examples
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
    reported: list[tuple[bool, str]] = field(default_factory=list)

    def block(self, one: str, other: str, *without: Prohibition) -> None:
        """A tree marks a way as blocked; then another is looked for, without what rules stop."""
        library, world = self.task.execution.library, self.task.execution.world_model
        found = {each.__name__: each for each in library.descriptions()}
        individuals = {"One": world.individual(one), "Other": world.individual(other)}
        call = SkillCall(found["Block"], None, MappingProxyType(individuals), NOWHERE)
        self.task.recover(
            Recovery(call, Afterwards.REPLAN, lambda *end: self.reported.append(end), without)
        )

    def to_the_end(self) -> Status:
        status, end = Status.RUNNING, time.monotonic() + 60
        while status is Status.RUNNING and time.monotonic() < end:
            status = self.task.tick()
            time.sleep(0.01)
        return status

    def path(self) -> list[str]:
        """The ways that were driven, each with its speed."""
        return [
            "{From.label} to {To.label} at {Speed}".format(**each.values)
            for each in self.events
            if each.skill == "Drive" and each.happened is Happened.STARTED
        ]


def begun(folder: Path, skill: str, *texts: str, source: str = SOURCE, scene: str = SCENE) -> Robot:
    plain, events, _ = Skills(folder, source, scene).task(skill, *texts)
    execution = plain.execution
    task = InterruptibleTask(
        plain.root.call, execution, replanner(execution.library, execution.world)
    )
    return Robot(task, events)


def test_a_way_around_what_a_tree_found_blocked(tmp_path: Path) -> None:
    robot = begun(tmp_path, "Deliver", "Robot=heron", "Place=hall", "Speed=0.3")
    robot.task.tick()
    robot.block("corridor", "hall")
    assert robot.to_the_end() is Status.SUCCESS
    assert robot.reported == [(True, "")]
    assert robot.path() == ["dock to yard at 0.3", "yard to hall at 0.3"]


def test_no_way_is_left(tmp_path: Path) -> None:
    robot = begun(tmp_path, "Deliver", "Robot=heron", "Place=hall", "Speed=0.3")
    robot.task.tick()
    world = robot.task.execution.world_model
    world.unrelate(
        world.individual("corridor"), "skiros:spatiallyRelated", world.individual("hall")
    )
    robot.block("yard", "hall")
    assert robot.to_the_end() is Status.FAILURE
    ((is_done, why),) = robot.reported
    assert not is_done
    assert why.startswith("no plan leads to the goal of the task: no skill achieves ")
    assert "Robot-1 skiros:at skiros:Location-5" in why


@pytest.mark.parametrize(
    ("was", "becomes", "why"),
    [
        (
            "self.post_conditions += Robot.at(Place)",
            "self.pre_conditions += Robot.at(Place) | ~Robot.at(Place)",
            "`Deliver` has no post-condition, so its goal is unknown",
        ),
        (
            "self.post_conditions += Robot.at(Place)",
            "self.post_conditions += Robot.at(Place) | ~Robot.at(Place)",
            "a post-condition of `Deliver` cannot be the goal of a plan",
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
    assert robot.reported == [(False, f"no plan leads to the goal of the task: {why}")]


def test_the_search_changes_nothing_in_the_world(tmp_path: Path) -> None:
    robot = begun(tmp_path, "Deliver", "Robot=heron", "Place=hall", "Speed=0.3")
    execution, task = robot.task.execution, robot.task.root.call
    (tmp_path / "before.turtle").write_text(execution.world.turtle())
    assert len(replanner(execution.library, execution.world)(task, ()).result(60)) == 2
    (tmp_path / "after.turtle").write_text(execution.world.turtle())
    assert (tmp_path / "before.turtle").read_text() == (tmp_path / "after.turtle").read_text()


# --- what rules stop ------------------------------------------------------------------------------

GIVEN = ("Deliver", "Robot=heron", "Place=hall", "Speed=0.3")
SKIROS = "http://rvmi.aau.dk/ontologies/skiros.owl#"
CONTAINER = f"{SKIROS}Container"
LOCATION = f"{SKIROS}Location"
ROBOT = "http://www.inf.ufrgs.br/phi-group/ontologies/cora.owl#Robot"
AT, RELATED = f"{SKIROS}at", f"{SKIROS}spatiallyRelated"
CORRIDOR, YARD = "skiros:Location-3 a skiros:Location", "skiros:Location-4 a skiros:Location"
TO_CONTAINERS = Prohibition("Drive", (("To", CONTAINER),))


def delivering(folder: Path, *containers: str) -> Robot:
    """A robot on its way to the hall, in a scene in which some places are containers."""
    scene = SCENE
    for each in containers:
        scene = scene.replace(each, each.replace("a skiros:Location", "a skiros:Container"))
    robot = begun(folder, *GIVEN, scene=scene)
    robot.task.tick()
    return robot


@pytest.mark.parametrize(
    ("container", "path"),
    [
        (CORRIDOR, ["dock to yard at 0.3", "yard to hall at 0.3"]),
        (YARD, ["dock to corridor at 0.3", "corridor to hall at 0.3"]),
    ],
)
def test_a_way_without_what_rules_stop(tmp_path: Path, container: str, path: list[str]) -> None:
    robot = delivering(tmp_path, container)
    robot.block("hall", "dock", TO_CONTAINERS)
    assert robot.to_the_end() is Status.SUCCESS
    assert robot.path() == path


def test_all_individuals_of_a_prohibition_have_to_be_of_its_classes(tmp_path: Path) -> None:
    robot = delivering(tmp_path, CORRIDOR, YARD)
    both = Prohibition("Drive", (("From", CONTAINER), ("To", CONTAINER)))
    robot.block("corridor", "hall", both)
    assert robot.to_the_end() is Status.SUCCESS
    assert robot.path() == ["dock to yard at 0.3", "yard to hall at 0.3"]


@pytest.mark.parametrize(
    ("without", "reason"),
    [
        (
            TO_CONTAINERS,
            "the rules forbid `Drive(To = skiros:Location-3)` and `Drive(To = skiros:Location-4)`",
        ),
        (Prohibition("Drive"), "the rules forbid `Drive`"),
        (
            Prohibition("Drive", (("From", CONTAINER), ("To", LOCATION))),
            "the rules forbid `Drive(From = skiros:Location-3, To = skiros:Location-5)` and "
            "`Drive(From = skiros:Location-4, To = skiros:Location-5)`",
        ),
    ],
)
def test_no_way_is_left_without_what_rules_stop(
    tmp_path: Path, without: Prohibition, reason: str
) -> None:
    robot = delivering(tmp_path, CORRIDOR, YARD)
    robot.block("hall", "dock", without)
    assert robot.to_the_end() is Status.FAILURE
    assert robot.path() == []
    ((is_done, why),) = robot.reported
    assert not is_done
    assert why.startswith("no plan leads to the goal of the task: no skill achieves ")
    assert why.endswith(f"({reason})")


def test_rules_are_no_reason_where_there_is_no_way_at_all(tmp_path: Path) -> None:
    robot = delivering(tmp_path, CORRIDOR)
    world = robot.task.execution.world_model
    world.unrelate(
        world.individual("corridor"), "skiros:spatiallyRelated", world.individual("hall")
    )
    robot.block("yard", "hall", TO_CONTAINERS)
    assert robot.to_the_end() is Status.FAILURE
    assert "rules" not in robot.reported[0][1]


def test_goals_that_exclude_each_other_for_the_rules_only(tmp_path: Path) -> None:
    """A way is gone after the robot has taken it, and one of them has to stay."""
    source = SOURCE.replace(
        "self.post_conditions += ~Robot.at(From)",
        "self.post_conditions += ~Robot.at(From)\n"
        "        self.post_conditions += ~From.spatiallyRelated(To)",
    ).replace(
        "Place: skiros.Location, Speed: float):\n",
        "Place: skiros.Location, One: skiros.Location, Other: skiros.Location):\n"
        "        self.post_conditions += One.spatiallyRelated(Other)\n",
    )
    scene = SCENE.replace(YARD, YARD.replace("a skiros:Location", "a skiros:Container"))
    individuals = ("Robot=heron", "Place=hall", "One=dock", "Other=corridor")
    robot = begun(tmp_path, "Deliver", *individuals, source=source, scene=scene)
    robot.task.tick()
    robot.block("hall", "dock", TO_CONTAINERS)
    assert robot.to_the_end() is Status.FAILURE
    why = robot.reported[0][1]
    assert "no sequence of skills reaches all goals together" in why
    assert "the rules forbid `Drive(To = a skiros:Container)`" in why


@pytest.fixture(scope="module")
def drive(tmp_path_factory: pytest.TempPathFactory) -> tuple[Ontology, PlanningAction]:
    """The skill that drives, as a planner has it."""
    robot = begun(tmp_path_factory.mktemp("drive"), *GIVEN)
    library, world = robot.task.execution.library, robot.task.execution.world
    found, _ = actions(library, world.ontology.model)
    return world.ontology, next(each for each in found if each.skill.name == "Drive")


@given(st.data())
@settings(max_examples=examples(60), deadline=None)
def test_what_is_in_reach_is_what_a_walk_finds(
    drive: tuple[Ontology, PlanningAction], data: st.DataObject
) -> None:
    """Places and ways at random: in reach without steps to or from classes of places is what a walk
    along the other ways comes to.
    """
    ontology, action = drive
    world = World(ontology)
    robot = world.new(ROBOT)
    kinds = data.draw(st.lists(st.sampled_from([LOCATION, CONTAINER]), min_size=2, max_size=5))
    places = [world.new(each) for each in kinds]
    ends = st.sampled_from(places)
    paths = data.draw(st.sets(st.tuples(ends, ends), max_size=12))
    for one, other in paths:
        if one != other:
            world.relate(one, RELATED, other)
    world.relate(robot, AT, places[0])
    limits = st.sampled_from([("From", CONTAINER), ("To", CONTAINER), ("To", LOCATION)])
    without = [
        Prohibition("Drive", tuple(each))
        for each in data.draw(st.lists(st.lists(limits, max_size=2, unique=True), max_size=2))
    ]
    reach = ReachableFacts(world, world.individuals(THING), permitted([action], without), math.inf)
    found = {
        each
        for each in places
        if reach.is_possible(FluentLiteral(Fluent(About.RELATION, AT), (robot, each)))
    }

    def is_stopped(one: str, other: str) -> bool:
        ends = {"From": one, "To": other}
        return any(
            all(world.is_a(ends[n], kind) for n, kind in each.individuals) for each in without
        )

    walked, waiting = {places[0]}, [places[0]]
    while waiting:
        one = waiting.pop()
        for other in set(world.related(one, RELATED)) - walked - {one}:
            if not is_stopped(one, other):
                walked.add(other)
                waiting.append(other)
    assert found == walked


def test_the_way_heeds_what_skills_lose_to_rules(tmp_path: Path) -> None:
    """The ways by the corridor and by the yard have the same length."""
    robot = begun(tmp_path, "Deliver", "Robot=heron", "Place=hall", "Speed=0.3")
    execution, task = robot.task.execution, robot.task.root.call

    def by(*costs: Cost) -> object:
        found = planned_calls(
            execution.library, task, execution.world, execution.world.copy(), costs=costs
        )
        return found[0].arguments["To"].label  # type: ignore[attr-defined]

    def cost(start: str, target: str) -> Cost:
        individuals = {
            "From": execution.world_model.individual(start),
            "To": execution.world_model.individual(target),
        }
        places = tuple((name, individual.iri) for name, individual in individuals.items())
        return Cost("Drive", places, executions=2, activations=1, lost_s=9.0)

    assert by(cost("corridor", "hall")) == "yard"
    assert by(cost("yard", "hall")) == "corridor"
