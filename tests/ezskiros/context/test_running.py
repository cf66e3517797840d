"""The engine knows which skills run: those that have started and not ended."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given, reject, settings
from hypothesis import strategies as st

from ezskiros.engine.events import Event, Happened
from ezskiros.engine.task import run
from support.depth import examples
from support.engine import FaultyTreeError, Skills

LEAVES = """
class Good(SkillDescription):
    def description(self, Ticks: int = 0):
        pass

class good(Good.SkillBase):
    def onStart(self):
        self.left = self.params.Ticks
        return True

    def execute(self):
        if self.left <= 0:
            return self.success("done")
        self.left -= 1
        return self.step("at it")

class Bad(SkillDescription):
    def description(self, Ticks: int = 0):
        pass

class bad(Bad.SkillBase):
    def onStart(self):
        self.left = self.params.Ticks
        return self.left >= 0

    def execute(self):
        if self.left > 100:
            return self.success("never, but a check does not know")
        if self.left <= 0:
            return self.fail("broken", -1)
        self.left -= 1
        return self.step("at it")

class Inner(SkillDescription):
    def description(self):
        pass

class inner(Inner.SkillBase):
    def expandBT(self, params):
        self.serialstar(Good(Ticks=1), Bad(Ticks=1))

class Task(SkillDescription):
    def description(self):
        pass

class task(Task.SkillBase):
    def expandBT(self, params):
        {tree}
"""
leaves = st.builds("{}(Ticks={})".format, st.sampled_from(["Good", "Bad"]), st.integers(-1, 3))
PROCESSORS = (
    *("serial", "serialstar", "selector", "selectorstar"),
    *("parallelff", "parallelfs", "nofail"),
)
trees = st.recursive(
    leaves | st.just("Inner()"),
    lambda below: (
        st.builds(
            lambda name, children: f"self.{name}({', '.join(children)})",
            st.sampled_from(PROCESSORS),
            st.lists(below, min_size=1, max_size=3),
        )
        | st.builds("self.retry({}, 2)".format, below)
        | st.builds("self.inverter({})".format, below)
        | st.builds("self.timeout({}, 0.1)".format, below)
    ),
    max_leaves=8,
)


class Followed:
    """The running skills according to events."""

    def __init__(self) -> None:
        self.paths: list[tuple[str, ...]] = []
        self.names: dict[tuple[str, ...], str] = {}

    def hear(self, event: Event) -> None:
        if event.happened is Happened.STARTED:
            self.paths.append(event.path)
            self.names[event.path] = event.skill
        elif event.happened in (Happened.SUCCEEDED, Happened.FAILED, Happened.PREEMPTED):
            self.paths = [each for each in self.paths if each != event.path]

    def running(self) -> list[str]:
        return sorted(self.names[each] for each in self.paths)


def followed(
    folder: Path,
    tree: str,
    at_tick: Callable[[list[str], list[str]], None],
    *,
    most: int = 12,
    compatible: bool = False,
) -> set[str]:
    """Run a task, and compare after each tick; the goals that were reported."""
    source = LEAVES.replace("{tree}", f"self.serialstar({tree})")
    skills = Skills(folder, source, options={"compatible": compatible})
    try:
        task, _, clock = skills.task("Task")
    except FaultyTreeError:  # a check sees that it never succeeds, or that a part is never reached
        reject()
    known, goals = Followed(), set[str]()
    task.execution.tell = known.hear
    running = task.execution.running
    running.changed = lambda: goals.update(each.goal for each in running)

    def look() -> None:
        at_tick(sorted(each.skill.name for each in running), known.running())

    def why_stop() -> str | None:
        return "enough" if task.ticks >= most else None

    run(task, wait=clock.wait, why_stop=why_stop, after_tick=look)
    look()
    assert list(running) == [], "nothing is left, however a task ends"
    return goals


@given(trees, st.booleans())
@settings(max_examples=examples(0.5), deadline=None)
def test_what_runs_is_what_has_started_and_not_ended(
    tmp_path_factory: pytest.TempPathFactory, tree: str, compatible: bool
) -> None:
    def compare(running: list[str], reported: list[str]) -> None:
        assert running == reported

    followed(tmp_path_factory.getbasetemp(), tree, compare, compatible=compatible)


def test_each_run_has_a_goal_of_its_own(tmp_path: Path) -> None:
    seen = list[list[str]]()
    tree = "self.retry(Bad(Ticks=1), 3)"
    goals = followed(tmp_path, tree, lambda running, _: seen.append(running), most=20)
    assert len(goals) == 1 + 3
    assert ["Bad", "Task"] in seen


HELD = """
class Wait(SkillDescription):
    def description(self, Object: skiros.Product):
        self.hold_conditions += Object.Weight < 3.0

class wait(Wait.SkillBase):
    def execute(self):
        self.world.set_value(self.params.Object, skiros.Weight, 5.0)
        return self.step("heavier")

    def onPreempt(self):
        return self.fail("stopped", -1)
"""


def test_a_broken_hold_condition_ends_it(tmp_path: Path) -> None:
    scene = "skiros:Product-1 a skiros:Product ; skiros:Weight 1.0 ."
    task, events, clock = Skills(tmp_path, HELD, scene).task("Wait", "Object=skiros:Product-1")
    outcome = run(task, wait=clock.wait)
    assert not outcome.is_success
    assert events[-1].happened is Happened.FAILED
    assert list(task.execution.running) == []
