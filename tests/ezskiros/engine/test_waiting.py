"""A guard in front of primitives: they wait before they start, and no code of users notices."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from pathlib import Path
from types import MappingProxyType

import pytest
from hypothesis import given, reject, settings
from hypothesis import strategies as st
from py_trees.common import Status

from ezskiros.engine.ahead import skills_ahead
from ezskiros.engine.events import Event, Happened
from ezskiros.engine.interruption import Afterwards, InterruptibleTask, Recovery
from ezskiros.engine.task import PERIOD, Task, run
from ezskiros.engine.tracing import TraceWriter
from ezskiros.session import NOWHERE
from ezskiros.skills.calls import SkillCall
from support.depth import examples
from support.engine import Clock, FaultyTreeError, Skills

SOURCE = """
noted = []


class Go(SkillDescription):
    def description(self, Name: str, Place: INFERRED[skiros.Location], Ends: str = "well"):
        self.pre_conditions += Place.spatiallyRelated(Place)


class go(Go.SkillBase):
    def __init__(self):
        super().__init__()
        noted.append("init")

    def onStart(self):
        noted.append("start " + self.params.Name)
        self.ticks = 0
        return True

    def execute(self):
        noted.append("execute")
        self.ticks += 1
        if self.ticks < 2:
            return self.step("on the way")
        return self.success("there") if self.params.Ends == "well" else self.fail("broken", -1)

    def onPreempt(self):
        noted.append("preempt")
        return self.fail("stopped", -1)

    def onEnd(self):
        noted.append("end")
        return True


class Look(SkillDescription):
    def description(self):
        pass


class look(Look.SkillBase):
    def execute(self):
        return self.success("seen")


class Task(SkillDescription):
    def description(self):
        pass


class task(Task.SkillBase):
    def expandBT(self, params):
        TREE
"""
SCENE = """
skiros:Location-2 a skiros:Location ; skiros:spatiallyRelated skiros:Location-2 .
"""
STOP = "rule `stop` is active"


class Rules:
    """Rules that are in front of some skills; their reasons are set from outside."""

    def __init__(self, *skills: str) -> None:
        self.skills = skills or ("Go",)
        self.reason: str | None = STOP
        self.asked: list[str] = []

    def __call__(self, skill: str) -> str | None:
        self.asked.append(skill)
        return self.reason if skill in self.skills else None


def begun(
    folder: Path, tree: str, guard: Rules | None, scene: str = SCENE
) -> tuple[Task, list[Event], Clock]:
    skills = Skills(folder, SOURCE.replace("TREE", tree), scene, {"guard": guard})
    return skills.task("Task")


def noted(task: Task) -> list[str]:
    """The notes of the code of users."""
    (found,) = (each for each in task.execution.library.descriptions() if each.__name__ == "Go")
    (kind,) = task.execution.library.implementations(found).values()
    return list(kind.onStart.__globals__["noted"])


def reported(events: Sequence[Event], skill: str = "Go") -> list[str]:
    return [f"{each.happened.value}: {each.text}" for each in events if each.skill == skill]


def test_a_primitive_waits_and_starts_in_the_tick_in_which_it_may(tmp_path: Path) -> None:
    rules = Rules()
    task, events, _ = begun(tmp_path, 'self.serialstar(Look(), Go(Name="a"))', rules)
    assert [task.tick() for _ in range(3)] == [Status.RUNNING] * 3
    assert reported(events) == [f"running: waits: {STOP}"]
    assert noted(task) == []
    assert [each.skill.name for each in task.execution.running] == ["Task"]
    rules.reason = None
    assert task.tick() is Status.RUNNING
    assert reported(events)[1:] == ["started: Start", "running: on the way"]
    assert noted(task) == ["init", "start a", "execute"]
    assert [each.skill.name for each in task.execution.running] == ["Task", "Go"]
    assert task.tick() is Status.SUCCESS


def test_another_reason_is_reported_too(tmp_path: Path) -> None:
    rules = Rules()
    task, events, _ = begun(tmp_path, 'self.serialstar(Go(Name="a"))', rules)
    for rules.reason in (STOP, STOP, "the active rules are unknown", STOP):
        task.tick()
    assert [each.partition("waits: ")[2] for each in reported(events)] == [
        STOP, "the active rules are unknown", STOP,
    ]  # fmt: skip


def test_conditions_are_asked_when_it_starts_and_not_before(tmp_path: Path) -> None:
    rules = Rules()
    nowhere = "skiros:Location-2 a skiros:Location .\n"
    task, events, _ = begun(tmp_path, 'self.serialstar(Go(Name="a"))', rules, nowhere)
    assert task.tick() is Status.RUNNING
    rules.reason = None
    assert task.tick() is Status.FAILURE
    assert reported(events)[1].startswith("failed: ")
    assert noted(task) == []


def test_what_runs_is_left_alone(tmp_path: Path) -> None:
    rules = Rules()
    rules.reason = None
    task, events, _ = begun(tmp_path, 'self.serialstar(Go(Name="a"), Go(Name="b"))', rules)
    task.tick()
    rules.reason = STOP
    task.tick()
    assert [each.partition(":")[0] for each in reported(events)] == [
        "started", "running", "succeeded", "running",
    ]  # fmt: skip
    assert reported(events)[-1] == f"running: waits: {STOP}"


def test_only_primitives_are_asked_about(tmp_path: Path) -> None:
    rules = Rules("Task", "Go")
    rules.reason = None
    task, _, _ = begun(tmp_path, 'self.serialstar(Look(), Go(Name="a"))', rules)
    while task.tick() is Status.RUNNING:
        pass
    assert rules.asked == ["Look", "Go"]


@pytest.mark.parametrize("compatible", [False, True])
def test_a_skill_that_is_stopped_while_it_waits_was_never_there(
    tmp_path: Path, compatible: bool
) -> None:
    options = {"guard": Rules(), "compatible": compatible}
    source = SOURCE.replace("TREE", 'self.serialstar(Go(Name="a"))')
    task, events, _ = Skills(tmp_path, source, SCENE, options).task("Task")
    task.tick()
    task.preempt()
    assert noted(task) == []
    assert reported(events)[-1] == "preempted: stopped before it started"
    assert list(task.execution.running) == []


def test_it_waits_anew_after_it_was_stopped(tmp_path: Path) -> None:
    rules = Rules()
    tree = 'self.parallelfs(Go(Name="a"), self.serialstar(Look()))'
    task, events, _ = begun(tmp_path, f"self.serialstar({tree}, Go(Name='b'))", rules)
    assert task.tick() is Status.RUNNING
    assert reported(events) == [
        f"running: waits: {STOP}",
        "preempted: stopped before it started",
        f"running: waits: {STOP}",
    ]
    rules.reason = None
    assert [task.tick(), task.tick()] == [Status.RUNNING, Status.SUCCESS]
    assert noted(task)[:2] == ["init", "start b"]


def test_the_wait_counts_for_a_time_limit(tmp_path: Path) -> None:
    tree = 'self.selectorstar(self.timeout(Go(Name="a"), 1.0), Look())'
    task, events, clock = begun(tmp_path, tree, Rules())
    outcome = run(task, wait=clock.wait)
    assert outcome.is_success
    assert outcome.seconds == pytest.approx(1.0, abs=2 * PERIOD)
    assert reported(events)[-1] == "preempted: stopped before it started"
    assert reported(events, "Look") == ["started: Start", "succeeded: seen"]
    assert noted(task) == []


def test_a_skill_that_waits_is_ahead_and_what_follows_a_time_limit(tmp_path: Path) -> None:
    tree = 'self.selectorstar(self.timeout(Go(Name="a"), 1.0), Look())'
    task, _, _ = begun(tmp_path, tree, Rules())
    task.tick()
    assert [each.skill.name for each in skills_ahead(task.root)] == ["Go", "Look"]


def test_a_tree_of_a_rule_takes_the_place_of_a_skill_that_waits(tmp_path: Path) -> None:
    plain, events, _ = begun(tmp_path, 'self.serialstar(Go(Name="a"))', Rules())
    task = InterruptibleTask(plain.root.call, plain.execution, lambda _, __: pytest.fail("no plan"))
    task.tick()
    (look,) = (
        SkillCall(each, None, MappingProxyType({}), NOWHERE)
        for each in plain.execution.library.descriptions()
        if each.__name__ == "Look"
    )
    done: list[tuple[bool, str]] = []
    task.recover(Recovery(look, Afterwards.RESUME, lambda *end: done.append(end)))
    task.tick()
    assert done == [(True, "")]
    task.tick()
    assert reported(events) == [
        f"running: waits: {STOP}",
        "preempted: stopped before it started",
        f"running: waits: {STOP}",
    ]
    assert noted(plain) == []


# --- any tree -------------------------------------------------------------------------------------

_CHILD = st.builds(
    'Go(Name="{}", Ends="{}")'.format, st.uuids(), st.sampled_from(["well", "badly"])
)


def _joined(children: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    several = st.lists(children, min_size=1, max_size=3).map(", ".join)
    kinds = st.sampled_from(["serialstar", "selectorstar", "serial", "parallelff", "parallelfs"])
    return st.one_of(
        st.builds("self.{}({})".format, kinds, several),
        st.builds("self.inverter({})".format, children),
        st.builds("self.timeout({}, 0.1)".format, children),
        st.builds("self.retry({}, 2)".format, children),
    )


TREES = _joined(st.recursive(_CHILD, _joined, max_leaves=8))


def trace_of(folder: Path, tree: str, guard: Rules | None) -> str:
    """The trace of a run, without its time of day, and the folder of its skills."""
    task, _, clock = begun(folder, tree, guard)
    file = io.StringIO()
    trace = TraceWriter(file, 0)
    task.execution.tell = lambda event: trace.write(event, task.ticks, clock())
    run(task, wait=clock.wait, why_stop=lambda: "too long" if task.ticks > 60 else None)
    return re.sub(r"/tmp\w+/skills", "skills", file.getvalue())


@given(tree=TREES)
@settings(max_examples=examples(0.2), deadline=None)
def test_a_guard_that_never_holds_anything_back_changes_nothing(
    tmp_path_factory: pytest.TempPathFactory, tree: str
) -> None:
    folder, rules = tmp_path_factory.mktemp("tree"), Rules()
    rules.reason = None
    try:
        assert trace_of(folder, tree, rules) == trace_of(folder, tree, None)
    except FaultyTreeError:  # a child that can never start
        reject()
    assert rules.asked


@given(tree=TREES, held=st.lists(st.booleans(), max_size=40))
@settings(max_examples=examples(0.2), deadline=None)
def test_nothing_starts_while_it_is_held_back_and_all_starts_that_is_free(
    tmp_path_factory: pytest.TempPathFactory, tree: str, held: list[bool]
) -> None:
    rules = Rules()
    try:
        task, events, clock = begun(tmp_path_factory.mktemp("tree"), tree, rules)
    except FaultyTreeError:
        reject()
    status = Status.RUNNING
    for is_held in [*held, *[False] * 60]:
        if status is not Status.RUNNING:
            break
        rules.reason = STOP if is_held else None
        ahead = {str(each.values.get("Name")) for each in skills_ahead(task.root)}
        before = len(events)
        status = task.tick()
        clock.wait(PERIOD)
        new = [each for each in events[before:] if each.skill == "Go"]
        started = [str(e.values["Name"]) for e in new if e.happened is Happened.STARTED]
        waits = [each for each in new if each.text.startswith("waits: ")]
        assert not (started if is_held else waits), tree
        assert not started or started[0] in ahead, tree
        waiting = list(task.root.tree.iterate()) if task.root.tree else []
        assert is_held or not any(getattr(each, "is_waiting", False) for each in waiting), tree
