"""A behavior tree interrupts a task, and the task goes on as it was asked to."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType

import pytest
from py_trees.common import Status

from ezskiros.engine.events import Event, Happened
from ezskiros.engine.interruption import (
    Afterwards,
    InterruptibleTask,
    NoPlanError,
    PlannedCalls,
    Recovery,
)
from ezskiros.engine.prohibitions import Prohibition
from ezskiros.session import NOWHERE
from ezskiros.skills.calls import SkillCall
from support.engine import Skills

SOURCE = """
class Go(SkillDescription):
    def description(self, Name: str, Ticks: int = 3): pass


class go(Go.SkillBase):
    def onStart(self):
        self.left = self.params.Ticks
        return True

    def execute(self):
        self.left -= 1
        if self.params.Name == "broken":
            return self.fail("it is broken")
        return self.success("there") if self.left <= 0 else self.step("on the way")

    def onPreempt(self):
        return self.fail("stands")


class Both(SkillDescription):
    def description(self): pass


class both(Both.SkillBase):
    def expandBT(self, params):
        self.serialstar(Go(Name="first", Ticks=2), Go(Name="second", Ticks=3))


class Clear(SkillDescription):
    def description(self): pass


class clear(Clear.SkillBase):
    def expandBT(self, params):
        self.serialstar(Go(Name="aside", Ticks=2), Go(Name="back", Ticks=1))


class Stuck(SkillDescription):
    def description(self): pass


class stuck(Stuck.SkillBase):
    def expandBT(self, params):
        self.serialstar(Go(Name="broken"))


class Patient(SkillDescription):
    def description(self): pass


class patient(Patient.SkillBase):
    def expandBT(self, params):
        self.parallelff(Go(Name="left", Ticks=5), self.serial(Go(Name="right", Ticks=5)))
"""


@dataclass
class Scene:
    """A task, and what has come of it."""

    task: InterruptibleTask
    events: list[Event]
    reported: list[tuple[bool, str]] = field(default_factory=list)

    def ask(self, skill: str, afterwards: Afterwards = Afterwards.RESUME) -> Recovery:
        recovery = Recovery(self.call(skill), afterwards, lambda *end: self.reported.append(end))
        self.task.recover(recovery)
        return recovery

    def call(self, skill: str) -> SkillCall:
        found = {each.__name__: each for each in self.task.execution.library.descriptions()}
        return SkillCall(found[skill], None, MappingProxyType({}), NOWHERE)

    def ticks(self, most: int) -> Status:
        """The status after so many ticks, or at the end."""
        status = Status.RUNNING
        for _ in range(most):
            if status is Status.RUNNING:
                status = self.task.tick()
        return status

    def lives(self) -> list[str]:
        """The start and end events of primitives, with their names."""
        shown = {Happened.STARTED: "+", Happened.SUCCEEDED: "", Happened.PREEMPTED: "!"}
        names: dict[tuple[str, ...], str] = {}
        found = []
        for each in self.events:
            if each.happened is Happened.STARTED and each.skill == "Go":
                names[each.path] = str(each.values["Name"])
            if each.happened in shown and each.path in names:
                found.append(f"{shown[each.happened]}{names[each.path]}")
        return found


Begin = Callable[..., Scene]


@pytest.fixture
def begin(tmp_path: Path) -> Begin:
    def begun(skill: str, search: Future[PlannedCalls] | None = None) -> Scene:
        search = search or Future()
        plain, events, _ = Skills(tmp_path, SOURCE).task(skill)
        return Scene(InterruptibleTask(plain.root.call, plain.execution, lambda *_: search), events)

    return begun


def test_each_tree_that_takes_the_place_of_another_is_reported_of(begin: Begin) -> None:
    search: Future[PlannedCalls] = Future()
    scene = begin("Both", search)
    trees: list[str] = []
    scene.task.begun = lambda tree: trees.append(tree.name)
    scene.ticks(3)
    assert trees == [], "the task is the first"
    scene.ask("Clear", Afterwards.REPLAN)
    search.set_result((scene.call("Patient"), scene.call("Both")))
    assert scene.ticks(30) is Status.SUCCESS
    assert trees == ["clear", "patient", "both"]


def test_what_was_done_stays_done(begin: Begin) -> None:
    scene = begin("Both")
    scene.ticks(3)
    scene.ask("Clear")
    assert scene.ticks(12) is Status.SUCCESS
    assert scene.lives() == [
        *("+first", "first", "+second", "!second"),
        *("+aside", "aside", "+back", "back"),
        *("+second", "second"),
    ]
    assert scene.reported == [(True, "")]


def test_a_task_that_is_retried_begins_anew(begin: Begin) -> None:
    scene = begin("Both")
    scene.ticks(3)
    scene.ask("Clear", Afterwards.RETRY)
    assert scene.ticks(14) is Status.SUCCESS
    assert scene.lives()[-4:] == ["+first", "first", "+second", "second"]
    assert scene.reported == [(True, "")]


def test_another_plan_leads_to_the_goal(begin: Begin) -> None:
    """Nothing moves until it is found; then its skills run one after the other."""
    search: Future[PlannedCalls] = Future()
    scene = begin("Both", search)
    scene.ticks(3)
    scene.ask("Clear", Afterwards.REPLAN)
    assert scene.ticks(10) is Status.RUNNING
    assert scene.lives()[-4:] == ["+aside", "aside", "+back", "back"]
    assert scene.reported == []
    search.set_result([scene.call("Patient"), scene.call("Clear")])
    scene.ticks(1)
    assert scene.reported == [(True, "")]
    assert scene.ticks(14) is Status.SUCCESS
    assert scene.lives()[-8:-4] == ["+left", "+right", "left", "right"]
    assert scene.lives()[-4:] == ["+aside", "aside", "+back", "back"]


def test_a_way_that_was_planned_before_takes_the_place_of_its_own_tree(begin: Begin) -> None:
    scene = begin("Both")
    scene.task.go_by([scene.call("Patient"), scene.call("Clear")])
    assert scene.lives() == [], "no skill runs before the first tick"
    assert scene.ticks(14) is Status.SUCCESS
    assert scene.lives() == ["+left", "+right", "left", "right", "+aside", "aside", "+back", "back"]


def test_another_plan_is_for_the_goal_of_the_task_and_not_for_that_of_a_step(
    tmp_path: Path,
) -> None:
    plain, events, _ = Skills(tmp_path, SOURCE).task("Both")
    asked: list[str] = []

    def replan(call: SkillCall, without: Sequence[Prohibition]) -> Future[PlannedCalls]:
        asked.append(call.skill.__name__)
        return Future()

    scene = Scene(InterruptibleTask(plain.root.call, plain.execution, replan), events)
    scene.task.go_by([scene.call("Patient")])
    scene.ticks(2)
    scene.ask("Clear", Afterwards.REPLAN)
    scene.ticks(6)
    assert asked == ["Both"]


def test_a_task_whose_goal_is_met_is_over(begin: Begin) -> None:
    search: Future[PlannedCalls] = Future()
    search.set_result([])
    scene = begin("Both", search)
    scene.ticks(3)
    scene.ask("Clear", Afterwards.REPLAN)
    assert scene.ticks(4) is Status.SUCCESS
    assert scene.reported == [(True, "")]
    assert [*scene.task.execution.running] == []


def test_without_a_plan_the_task_has_failed(begin: Begin) -> None:
    search: Future[PlannedCalls] = Future()
    search.set_exception(NoPlanError("all ways are blocked"))
    scene = begin("Both", search)
    scene.ticks(3)
    scene.ask("Clear", Afterwards.REPLAN)
    assert scene.ticks(5) is Status.FAILURE
    why = "no plan leads to the goal of the task: all ways are blocked"
    assert scene.reported == [(False, why)]
    assert [*scene.task.execution.running] == []


def test_a_rule_that_is_released_ends_no_search(begin: Begin) -> None:
    """The tree has found that the old way is none."""
    search: Future[PlannedCalls] = Future()
    scene = begin("Both", search)
    scene.ticks(3)
    recovery = scene.ask("Clear", Afterwards.REPLAN)
    scene.ticks(5)
    recovery.release()
    scene.ticks(1)
    search.set_result([scene.call("Patient")])
    assert scene.ticks(7) is Status.SUCCESS
    assert scene.reported == [(True, "")]
    assert scene.lives()[-4:] == ["+left", "+right", "left", "right"]


def test_a_task_is_retried_as_it_began_after_another_way(begin: Begin) -> None:
    search: Future[PlannedCalls] = Future()
    scene = begin("Both", search)
    search.set_result([scene.call("Patient"), scene.call("Clear")])
    scene.ticks(3)
    scene.ask("Clear", Afterwards.REPLAN)
    scene.ticks(6)
    assert scene.lives()[-2:] == ["+left", "+right"]
    scene.ask("Clear", Afterwards.RETRY)
    assert scene.ticks(14) is Status.SUCCESS
    assert scene.lives()[-4:] == ["+first", "first", "+second", "second"]


def test_all_that_runs_is_preempted_at_the_next_tick(begin: Begin) -> None:
    scene = begin("Patient")
    scene.ticks(2)
    scene.ask("Clear")
    scene.ticks(1)
    assert scene.lives() == ["+left", "+right", "!left", "!right", "+aside"]


def test_a_recovery_that_fails_ends_the_task(begin: Begin) -> None:
    scene = begin("Both")
    scene.ticks(3)
    scene.ask("Stuck")
    assert scene.ticks(1) is Status.FAILURE
    assert scene.reported == [(False, "the recovery has failed: it is broken")]
    assert scene.task.root.status is Status.INVALID
    assert [*scene.task.execution.running] == []


def test_a_rule_that_is_released_ends_the_tree(begin: Begin) -> None:
    scene = begin("Both")
    scene.ticks(3)
    recovery = scene.ask("Clear")
    scene.ticks(1)
    recovery.release()
    assert scene.ticks(3) is Status.SUCCESS
    assert scene.lives()[-4:] == ["+aside", "!aside", "+second", "second"]
    assert scene.reported == [(False, "it was stopped")]


def test_a_tree_that_is_released_before_the_next_tick_never_begins(begin: Begin) -> None:
    scene = begin("Both")
    scene.ticks(3)
    scene.ask("Clear").release()
    assert scene.ticks(3) is Status.SUCCESS
    assert scene.lives() == ["+first", "first", "+second", "second"]
    assert scene.reported == [(False, "it was stopped")]


def test_a_release_ends_no_tree_of_another_rule(begin: Begin) -> None:
    """The node cancels one goal and sends another at once; they may come in either order."""
    scene = begin("Both")
    scene.ticks(3)
    first = scene.ask("Clear")
    scene.ticks(1)
    scene.ask("Patient")
    first.release()
    scene.ticks(1)
    assert scene.reported == [(False, "it was stopped")]
    assert scene.lives()[-4:] == ["+aside", "!aside", "+left", "+right"]
    first.release()
    assert scene.ticks(12) is Status.SUCCESS
    assert scene.reported[1:] == [(True, "")]


def test_a_tree_gives_way_to_another(begin: Begin) -> None:
    scene = begin("Both")
    scene.ticks(3)
    scene.ask("Clear")
    scene.ticks(1)
    scene.ask("Patient")
    scene.ticks(1)
    assert scene.reported == [(False, "another tree was requested")]
    assert scene.lives()[-4:] == ["+aside", "!aside", "+left", "+right"]


def test_a_task_that_is_stopped_stops_its_tree(begin: Begin) -> None:
    scene = begin("Both")
    scene.ticks(3)
    scene.ask("Clear")
    scene.ticks(1)
    scene.task.preempt()
    assert scene.reported == [(False, "the task is stopped")]
    assert [*scene.task.execution.running] == []


def test_a_tree_is_asked_for_from_any_thread(begin: Begin) -> None:
    scene = begin("Both")
    scene.ticks(3)
    asking = threading.Thread(target=lambda: scene.ask("Clear"))
    asking.start()
    asking.join()
    assert scene.ticks(12) is Status.SUCCESS
    assert scene.reported == [(True, "")]


def test_the_context_tells_of_the_tree(begin: Begin) -> None:
    """Rules see which skills run: the compound that waits, and those of the tree."""
    scene = begin("Both")
    scene.ticks(3)
    scene.ask("Clear")
    scene.ticks(1)
    assert [each.skill.name for each in scene.task.execution.running] == ["Both", "Clear", "Go"]
