"""A tree takes the place of the tasks that SkiROS2's own ticker ticks, and they go on after it."""
# mypy: disable-error-code="no-untyped-call"

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from types import MappingProxyType
from typing import Any

import pytest

from ezskiros.context.ros import NoRosError
from ezskiros.context.snapshot import Snapshot
from ezskiros.engine.interruption import Afterwards, Recovery
from ezskiros.engine.recovery_goals import RecoveryGoals, RefusedGoalError
from ezskiros.hosts import skiros2_context, skiros2_recovery
from ezskiros.hosts.skiros2_api import api, ticker
from ezskiros.hosts.skiros2_context import HostedContext
from ezskiros.hosts.skiros2_loading import _hosted
from ezskiros.hosts.skiros2_recovery import HostedRecoveries, HostedTree
from ezskiros.session import NOWHERE
from ezskiros.skills.calls import SkillCall
from support import skiros2_core
from support.parts import SKIROS2, needs

pytestmark = [
    needs(SKIROS2),
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),  # of what SkiROS2 uses
]

SKILLS = """
NOTES = []


class Go(SkillDescription):
    def description(self, Name: str, Ticks: int = 3):
        pass


class go(Go.SkillBase):
    def onStart(self):
        NOTES.append(f"+{self.params.Name}")
        self.left = self.params.Ticks
        return True

    def execute(self):
        self.left -= 1
        if self.params.Name == "broken":
            return self.fail("it is broken", -1)
        if self.left > 0:
            return self.step("on the way")
        NOTES.append(self.params.Name)
        return self.success("there")

    def onPreempt(self):
        NOTES.append(f"!{self.params.Name}")
        return self.fail("stands", -1)


class Both(SkillDescription):
    def description(self):
        pass


class both(Both.SkillBase):
    def expandBT(self, params):
        self.serialstar(Go(Name="first", Ticks=2), Go(Name="second"))


class Clear(SkillDescription):
    def description(self):
        pass


class clear(Clear.SkillBase):
    def expandBT(self, params):
        self.serialstar(Go(Name="aside", Ticks=2), Go(Name="back", Ticks=1))


class Stuck(SkillDescription):
    def description(self):
        pass


class stuck(Stuck.SkillBase):
    def expandBT(self, params):
        self.serialstar(Go(Name="broken"))
"""
BEGUN = ["+first", "first", "+second"]
STOPPED = [*BEGUN, "!second"]
RECOVERED = [*STOPPED, "+aside", "aside", "+back", "back"]
TASK = 1


class Robot:
    """SkiROS2's ticker with a task, and what recovers from it."""

    def __init__(self, core: skiros2_core.Core, library: str) -> None:
        self.core = core
        core.load(library, "both", "go")
        self.module = sys.modules[f"{library}.skills"]
        context = HostedContext("digest", list[Snapshot]().append)
        skiros2_context._contexts.append(context)
        self.recoveries = HostedRecoveries(map(self.tree, self.descriptions()), context)
        self.reported: list[tuple[bool, str]] = []
        self.ticker = ticker()()
        self.ticker.observe_progress(lambda **_: None)
        self.ticker._visitor.setVerbose(False)
        self._usual: Callable[[Any], None] = ticker()._tick

    @property
    def notes(self) -> list[str]:
        found: list[str] = self.module.NOTES
        return found

    def descriptions(self) -> list[Any]:
        return [getattr(self.module, name) for name in ("Go", "Both", "Clear", "Stuck")]

    def tree(self, description: Any) -> HostedTree:
        found, name = _hosted[description], description.__name__.lower()
        return HostedTree(description, found.skill, found.ontology, (name,))

    def begin(self) -> None:
        root = api().Root("root", self.core.wm)
        root.addChild(api().SkillWrapper("skiros:Both", "both", self.core.instanciator))
        self.ticker.add_task(root, TASK)

    def ask(self, skill: str, afterwards: Afterwards = Afterwards.RESUME) -> Recovery:
        call = SkillCall(getattr(self.module, skill), None, MappingProxyType({}), NOWHERE)
        recovery = Recovery(call, afterwards, lambda *end: self.reported.append(end))
        self.recoveries.recover(recovery)
        return recovery

    def ticks(self, count: int) -> None:
        for _ in range(count):
            if self.ticker._tasks:
                self.recoveries.tick(self.ticker, self._usual)

    def running(self) -> list[str]:
        return [each.skill.name for each in self.recoveries.running]


@pytest.fixture
def robot(package: Any, monkeypatch: pytest.MonkeyPatch) -> Robot:
    """The second primitive of its task has begun."""
    core = skiros2_core.Core()
    visitor = api().VisitorExecutor(core.wm, core.instanciator)
    alone = {"_tasks": {}, "_tasks_to_preempt": [], "_tasks_to_pause": {}, "_visitor": visitor}
    for name, value in alone.items():
        monkeypatch.setattr(ticker(), name, value)
    monkeypatch.setattr(skiros2_context, "_contexts", [])
    found = Robot(core, package("library", SKILLS))
    found.begin()
    found.ticks(3)
    assert found.notes == BEGUN
    return found


def test_what_was_done_stays_done(robot: Robot) -> None:
    robot.ask("Clear")
    robot.ticks(12)
    assert robot.notes == [*RECOVERED, "+second", "second"]
    assert robot.reported == [(True, "")]
    assert robot.ticker._tasks == {}


def test_all_tasks_are_retried(robot: Robot) -> None:
    robot.ask("Clear", Afterwards.RETRY)
    robot.ticks(14)
    assert robot.notes == [*RECOVERED, "+first", "first", "+second", "second"]
    assert robot.reported == [(True, "")]


def test_nobody_plans_again(robot: Robot) -> None:
    with pytest.raises(RefusedGoalError, match="use `then retry`"):
        robot.ask("Clear", Afterwards.REPLAN)
    robot.ticks(4)
    assert robot.notes == [*BEGUN, "second"]


def test_a_recovery_that_fails_ends_the_tasks(robot: Robot) -> None:
    robot.ask("Stuck")
    robot.ticks(1)
    assert robot.reported == [(False, "the recovery has failed")]
    assert robot.notes == [*STOPPED, "+broken"]
    assert robot.ticker._tasks == {}
    assert robot.running() == []


def test_a_rule_that_is_released_ends_the_tree(robot: Robot) -> None:
    recovery = robot.ask("Clear")
    robot.ticks(1)
    recovery.release()
    robot.ticks(4)
    assert robot.notes == [*STOPPED, "+aside", "!aside", "+second", "second"]
    assert robot.reported == [(False, "it was stopped")]


def test_a_tree_that_is_released_before_the_next_tick_never_begins(robot: Robot) -> None:
    robot.ask("Clear").release()
    robot.ticks(4)
    assert robot.notes == [*BEGUN, "second"]
    assert robot.reported == [(False, "it was stopped")]


def test_a_tree_gives_way_to_another(robot: Robot) -> None:
    first = robot.ask("Clear")
    robot.ticks(1)
    robot.ask("Clear")
    first.release()
    robot.ticks(1)
    assert robot.notes == [*STOPPED, "+aside", "!aside", "+aside"]
    robot.ticks(12)
    assert robot.reported == [(False, "it was stopped"), (True, "")]
    assert robot.notes[-2:] == ["+second", "second"]


def test_the_newest_tree_is_run(robot: Robot) -> None:
    robot.ask("Clear")
    robot.ask("Stuck")
    robot.ticks(1)
    assert robot.reported == [
        (False, "another tree was requested"),
        (False, "the recovery has failed"),
    ]


def test_a_task_that_is_stopped_stops_the_tree(robot: Robot) -> None:
    robot.ask("Clear")
    robot.ticks(1)
    robot.ticker._tasks_to_preempt.append(TASK)
    robot.ticks(3)
    assert robot.reported == [(False, "the task is stopped")]
    assert robot.notes[-2:] == ["+aside", "!aside"]
    assert robot.ticker._tasks == {}


def test_a_tree_that_skiros2_does_not_have_stops_nothing(robot: Robot) -> None:
    (found,) = (each for each in robot.descriptions() if each.__name__ == "Clear")
    robot.recoveries.add([replace(robot.tree(found), implementations=("nothing",))])
    robot.ask("Clear")
    robot.ticks(4)
    ((is_success, why),) = robot.reported
    assert not is_success
    assert why.startswith("SkiROS2 cannot run it: ")
    assert robot.notes == [*BEGUN, "second"]


def test_the_skills_of_the_task_are_those_that_ran_before_the_tree(robot: Robot) -> None:
    """SkiROS2 runs the primitive of the tree with the implementation that the task has used."""
    assert robot.running() == ["Both", "Go"]
    robot.ask("Clear")
    robot.ticks(1)
    assert [(each.skill.name, each.values().get("Name")) for each in robot.recoveries.running] == [
        ("Both", None),
        ("Go", "second"),
    ]
    robot.ticks(12)
    assert robot.running() == []


def test_individuals_stand_by_their_labels(robot: Robot) -> None:
    (shelf, _) = (robot.core.add("skiros:Location", each) for each in ("shelf", "table"))
    world = robot.recoveries.world
    assert [world.spelled(each) for each in world.labelled("shelf")] == [shelf.id]
    assert world.labelled("shel") == []
    assert world.labelled("") == []


def test_without_a_task_there_is_no_world(robot: Robot) -> None:
    robot.ticks(9)
    with pytest.raises(RefusedGoalError, match="no task runs"):
        _ = robot.recoveries.world


def test_several_libraries_have_one_server(robot: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(skiros2_recovery, "_recoveries", [])
    monkeypatch.setattr(ticker(), "_tick", ticker()._tick)
    (context,) = skiros2_context._contexts
    served: list[RecoveryGoals] = []
    both, clear = (robot.tree(each) for each in robot.descriptions()[1:3])
    for each in (both, clear):
        assert skiros2_recovery.begin([each], context, served.append) is None
    (goals,) = served
    robot.reported.clear()
    goals.begin("digest", "Clear", [], "resume", [], lambda *end: robot.reported.append(end))
    for _ in range(12):
        if robot.ticker._tasks:
            robot.ticker._tick()
    assert robot.notes == [*RECOVERED, "+second", "second"]
    assert robot.reported == [(True, "")]


def test_without_ros_there_is_none(robot: Robot, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(skiros2_recovery, "_recoveries", [])
    usual, (context,) = ticker()._tick, skiros2_context._contexts

    def serving(_: RecoveryGoals) -> object:
        raise NoRosError("no ROS master answers")

    assert skiros2_recovery.begin([], context, serving) == "no ROS master answers"
    assert ticker()._tick is usual
    assert skiros2_recovery._recoveries == []
