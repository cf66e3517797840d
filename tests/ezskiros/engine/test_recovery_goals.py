"""Goals of rules: what they ask for is run, and what is wrong with them is said."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future
from pathlib import Path

import pytest
from py_trees.common import Status

from ezskiros.engine.events import Event, Happened
from ezskiros.engine.interruption import InterruptibleTask, Recovery
from ezskiros.engine.prohibitions import Prohibition
from ezskiros.engine.recovery_goals import RecoveryGoals, RefusedGoalError, TaskHost
from support.engine import Skills

DIGEST = "ab" * 32
SCENE = """
skiros:Location-1 a skiros:Location ; rdfs:label "kitchen" .
skiros:Location-2 a skiros:Location ; rdfs:label "store" .
"""
SOURCE = """
class Gear(enum.Enum):
    SLOW = 1
    FAST = 2


class Drive(SkillDescription):
    def description(self, Target: skiros.Location, Speed: float = 0.5, Quietly: bool = False,
                    Gear: Gear = Gear.SLOW): pass


class drive(Drive.SkillBase):
    def onStart(self):
        self.left = 3
        return True

    def execute(self):
        self.left -= 1
        return self.success("there") if self.left == 0 else self.step("on the way")

    def onPreempt(self):
        return self.fail("stands")


class Reroute(SkillDescription):
    def description(self, Target: skiros.Location, Speed: float, Quietly: bool, Gear: Gear): pass


class reroute(Reroute.SkillBase):
    def expandBT(self, params):
        self.serialstar(Drive())
"""


class Robot:
    """A task that drives to the kitchen, and the goals that interrupt it."""

    def __init__(self, folder: Path) -> None:
        plain, self.events, _ = Skills(folder, SOURCE, SCENE).task(
            "Drive", "Target=kitchen", "Speed=0.25", "Gear=FAST"
        )
        self.task = InterruptibleTask(plain.root.call, plain.execution, lambda *_: Future())
        self.goals = RecoveryGoals(DIGEST, TaskHost(self.task))
        self.reported: list[tuple[bool, str]] = []
        self.task.tick()

    def begin(
        self,
        *arguments: str,
        skill: str = "Reroute",
        digest: str = DIGEST,
        afterwards: str = "resume",
        without: Sequence[str] = (),
    ) -> Recovery:
        return self.goals.begin(
            digest, skill, arguments, afterwards, without, lambda *end: self.reported.append(end)
        )

    def started(self, skill: str) -> Event:
        started = (each for each in self.events if each.happened is Happened.STARTED)
        return [each for each in started if each.skill == skill][-1]

    def ends(self) -> Status:
        while (status := self.task.tick()) is Status.RUNNING:
            pass
        return status


@pytest.fixture
def robot(tmp_path: Path) -> Robot:
    return Robot(tmp_path)


def test_values_are_those_that_are_written(robot: Robot) -> None:
    robot.begin("Target=store", "Speed=0.1", "Quietly=true", "Gear=SLOW")
    assert robot.ends() is Status.SUCCESS
    values = robot.started("Reroute").values
    assert str(values["Target"]) == "skiros:Location-2"
    assert (values["Speed"], values["Quietly"], values["Gear"].name) == (0.1, True, "SLOW")
    assert robot.reported == [(True, "")]


def test_a_number_with_a_default_need_not_be_given(robot: Robot) -> None:
    robot.begin("Target=store", skill="Drive")
    assert robot.ends() is Status.SUCCESS
    (recovering,) = (
        each.values
        for each in robot.events
        if each.happened is Happened.STARTED and str(each.values["Target"]) == "skiros:Location-2"
    )
    assert recovering["Speed"] == 0.5


def test_values_are_those_of_the_skill_that_runs(robot: Robot) -> None:
    passed = [f"{name}=@Drive.{name}" for name in ("Target", "Speed", "Quietly", "Gear")]
    robot.begin(*passed)
    robot.ends()
    values = robot.started("Reroute").values
    assert str(values["Target"]) == "skiros:Location-1"
    assert (values["Speed"], values["Quietly"], values["Gear"].name) == (0.25, False, "FAST")


def test_values_are_those_of_the_skill_that_another_tree_interrupts(robot: Robot) -> None:
    """It does not run any more; the tree that gives way has a Drive of its own."""
    passed = [f"{name}=@Drive.{name}" for name in ("Target", "Speed", "Quietly", "Gear")]
    robot.begin("Target=store", *GIVEN)
    robot.task.tick()
    assert [str(each.values()["Target"]) for each in robot.task.execution.running][-1:] == [
        "skiros:Location-2"
    ]
    robot.begin(*passed)
    robot.task.tick()
    assert str(robot.started("Reroute").values["Target"]) == "skiros:Location-1"
    assert robot.ends() is Status.SUCCESS
    assert robot.reported == [(False, "another tree was requested"), (True, "")]


def test_a_skill_that_runs_again_has_its_new_values(robot: Robot) -> None:
    robot.begin("Target=store", *GIVEN)
    while not robot.reported:
        robot.task.tick()
    robot.task.tick()
    assert [*robot.task.running] == [*robot.task.execution.running]


GIVEN = ("Speed=1", "Quietly=true", "Gear=SLOW")


@pytest.mark.parametrize(
    ("arguments", "skill", "reason"),
    [
        (("Target=cellar", *GIVEN), "Reroute", "`Target`: there is no 'cellar' in the world"),
        (
            ("Target=@Lift.Target", *GIVEN),
            "Reroute",
            "`Target` takes its value from `Lift`, which does not",
        ),
        (
            ("Target=@Drive.Goal", *GIVEN),
            "Reroute",
            "`Target` takes its value from `Drive`, which does not",
        ),
        (GIVEN, "Reroute", "`Target`, a skiros.Location, is not given"),
        ((), "Fly", "there is no skill `Fly`"),
    ],
)
def test_what_cannot_be_run_is_refused(
    robot: Robot, arguments: tuple[str, ...], skill: str, reason: str
) -> None:
    with pytest.raises(RefusedGoalError) as problem:
        robot.begin(*arguments, skill=skill)
    assert str(problem.value).startswith(reason)
    assert robot.ends() is Status.SUCCESS, "the task goes on; the rule does what stands behind else"


def test_rules_of_another_export_are_refused(robot: Robot) -> None:
    with pytest.raises(RefusedGoalError, match="another export"):
        robot.begin("Target=store", digest="cd" * 32)


def test_a_goal_that_is_cancelled_ends(robot: Robot) -> None:
    recovery = robot.begin("Target=store", *GIVEN)
    robot.task.tick()
    recovery.release()
    assert robot.ends() is Status.SUCCESS
    assert robot.reported == [(False, "it was stopped")]


def test_a_task_goes_on_in_a_way_that_is_known(robot: Robot) -> None:
    with pytest.raises(RefusedGoalError, match="cannot continue with `dance`"):
        robot.begin("Target=store", *GIVEN, afterwards="dance")


# --- what rules stop ------------------------------------------------------------------------------

CONTAINER = "http://rvmi.aau.dk/ontologies/skiros.owl#Container"
LOCATION = "http://rvmi.aau.dk/ontologies/skiros.owl#Location"


def test_what_rules_stop_goes_along(robot: Robot) -> None:
    without = [
        "Reroute",
        "Drive(Target=skiros.Container)",
        "Drive(Target=skiros.Container, Target=skiros.Location)",
    ]
    recovery = robot.begin("Target=store", *GIVEN, afterwards="replan", without=without)
    assert recovery.without == (
        Prohibition("Reroute"),
        Prohibition("Drive", (("Target", CONTAINER),)),
        Prohibition("Drive", (("Target", CONTAINER), ("Target", LOCATION))),
    )


@pytest.mark.parametrize(
    ("without", "reason"),
    [
        ("Fly", "there is no skill `Fly`"),
        ("Drive(Goal=skiros.Location)", "`Drive` has no parameter `Goal` for an individual"),
        ("Drive(Speed=skiros.Location)", "`Drive` has no parameter `Speed` for an individual"),
        ("Drive(Target=skiros.Corridor)", "the ontology has no class `skiros.Corridor`"),
        ("Drive(Target=skiros.at)", "the ontology has no class `skiros.at`"),
        ("Drive(Target)", "the ontology has no class ``"),
        ("Drive()", "`Drive()` is not a skill, or a skill with the classes of its individuals"),
        (
            "Drive(Target=skiros.Location) or Fly",
            "is not a skill, or a skill with the classes of its individuals",
        ),
        ("", "`` is not a skill, or a skill with the classes of its individuals"),
    ],
)
def test_a_goal_that_is_not_understood_whole_is_refused(
    robot: Robot, without: str, reason: str
) -> None:
    with pytest.raises(RefusedGoalError) as problem:
        robot.begin("Target=store", *GIVEN, afterwards="replan", without=["Drive", without])
    assert str(problem.value).startswith("the list of forbidden skills is wrong: ")
    assert reason in str(problem.value)
    assert robot.reported == []
