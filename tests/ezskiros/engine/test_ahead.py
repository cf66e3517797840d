"""The skills that can start next in a tree, beside those that start when it is ticked on."""

from __future__ import annotations

import inspect
import sys
from pathlib import Path

import pytest
from hypothesis import given, reject, settings
from hypothesis import strategies as st
from py_trees.common import Status

from ezskiros.engine.ahead import skills_ahead
from ezskiros.engine.events import Event, Happened
from ezskiros.engine.task import Task
from support.engine import FaultyTreeError, Skills

SOURCE = """
class Go(SkillDescription):
    def description(self, Name: str, Place: INFERRED[skiros.Location], Ends: str = "well"):
        self.pre_conditions += Place.spatiallyRelated(Place)


class go(Go.SkillBase):
    def onStart(self):
        self.ticks = 0
        return True

    def execute(self):
        self.ticks += 1
        if self.ticks < 2:
            return self.step("on the way")
        return self.success("there") if self.params.Ends == "well" else self.fail("broken", -1)


class Leg(SkillDescription):
    def description(self, Name: str):
        pass


class leg(Leg.SkillBase):
    def expandBT(self, params):
        self.serialstar(Go(Name=params.Name), Go(Name="then"))


class Dynamic(SkillDescription):
    def description(self, Far: bool):
        pass


class dynamic(Dynamic.SkillBase):
    def expandBT(self, params):
        self.serialstar(Go(Name="far" if params.Far else "near"))


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


def task_of(folder: Path, tree: str) -> tuple[Task, list[Event]]:
    found, events, _ = Skills(folder, SOURCE.replace("TREE", tree), SCENE).task("Task")
    return found, events


def named(task: Task) -> set[str]:
    """The skills ahead, primitives by what they are called."""
    return {str(each.values.get("Name", each.skill.name)) for each in skills_ahead(task.root)}


@pytest.mark.parametrize(
    ("tree", "ahead"),
    [
        ('self.serialstar(Go(Name="a"), Go(Name="b"), Go(Name="c"))', {"b"}),
        ('self.serialstar(Go(Name="a"))', set()),
        ('self.selectorstar(Go(Name="a"), Go(Name="b"))', {"b"}),
        (
            'self.serialstar(self.selectorstar(Go(Name="a"), Go(Name="b")), Go(Name="c"))',
            {"b", "c"},
        ),
        ('self.parallelff(Go(Name="a"), self.serialstar(Go(Name="b"), Go(Name="c")))', {"c"}),
        ('self.serialstar(Go(Name="a"), self.parallelff(Go(Name="b"), Go(Name="c")))', {"b", "c"}),
        ('self.retry(Go(Name="a"), 3)', {"a"}),
        ('self.serialstar(self.nofail(Go(Name="a")), Go(Name="b"))', {"b"}),
        ('self.serialstar(self.inverter(Go(Name="a")), Go(Name="b"))', {"b"}),
        ('self.serialstar(self.timeout(Go(Name="a"), 9.0), Go(Name="b"))', {"b"}),
        ('self.serialstar(Go(Name="a"), Leg(Name="b"))', {"b"}),
        ('self.serialstar(Leg(Name="a"), Go(Name="b"))', {"then"}),
        ('self.serialstar(Go(Name="a"), Dynamic(Far=True))', {"Dynamic"}),
    ],
)
def test_what_can_start_next(tmp_path: Path, tree: str, ahead: set[str]) -> None:
    task, _ = task_of(tmp_path, tree)
    task.tick()
    assert named(task) == ahead


def test_before_a_task_begins_its_beginning_is_ahead(tmp_path: Path) -> None:
    task, _ = task_of(tmp_path, 'self.serialstar(Leg(Name="a"), Go(Name="b"))')
    assert [each.skill.name for each in skills_ahead(task.root)] == ["Task", "Leg", "Go"]
    assert named(task) == {"Task", "a"}


def test_a_value_that_is_found_at_the_start_is_not_known(tmp_path: Path) -> None:
    task, _ = task_of(tmp_path, 'self.serialstar(Leg(Name="a"), Leg(Name="b"))')
    task.tick()
    task.tick()
    leg, first = (each for each in skills_ahead(task.root))
    assert leg.values == {"Name": "b"}
    assert first.values == {"Name": "b", "Ends": "well"}


def test_a_deep_task_has_all_ahead_of_it_too(tmp_path: Path) -> None:
    tree = 'Go(Name="a")'
    for _ in range(80):
        tree = f"self.serialstar({tree})"
    task, _ = task_of(tmp_path, f"self.serialstar(self.serialstar({tree}), Go(Name='b'))")
    assert named(task) == {"Task", "a"}
    task.tick()
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(len(inspect.stack()) + 60)
    try:
        assert named(task) == {"b"}
    finally:
        sys.setrecursionlimit(limit)


_CHILD = st.builds(
    'Go(Name="{}", Ends="{}")'.format, st.uuids(), st.sampled_from(["well", "badly"])
)


def _joined(children: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    several = st.lists(children, min_size=1, max_size=3).map(", ".join)
    kinds = st.sampled_from(
        ["serialstar", "selectorstar", "serial", "selector", "parallelff", "parallelfs", "nofail"]
    )
    return st.one_of(
        st.builds("self.{}({})".format, kinds, several),
        st.builds("self.inverter({})".format, children),
        st.builds("self.retry({}, 2)".format, children),
    )


@given(tree=_joined(st.recursive(_CHILD, _joined, max_leaves=8)))
@settings(max_examples=100, deadline=None)
def test_nothing_starts_that_was_not_ahead(
    tmp_path_factory: pytest.TempPathFactory, tree: str
) -> None:
    """A skill that starts within a tick was ahead before, or follows a skill of this tick."""
    try:
        task, events = task_of(tmp_path_factory.mktemp("tree"), tree)
    except FaultyTreeError:  # a child that can never start
        reject()
    status, ticks = Status.RUNNING, 0
    while status is Status.RUNNING and ticks < 60:
        ahead, before, ticks = named(task), len(events), ticks + 1
        status = task.tick()
        new = [e for e in events[before:] if e.happened is Happened.STARTED and e.skill == "Go"]
        if new:
            assert str(new[0].values["Name"]) in ahead, tree
