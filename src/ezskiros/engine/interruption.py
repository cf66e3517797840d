"""A task that a recovery tree interrupts, after a finding of a rule (thesis, section 5.2).

A monitor of the robot requests a tree, from any thread. At the next tick the running primitives are
preempted, and the tree is ticked instead of the task. After the tree has succeeded, the task
continues as requested. A failed tree ends the task, because it is unknown whether the task can
continue.

During the search for another plan, nothing moves.
"""

from __future__ import annotations

import enum
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field, replace
from queue import Empty, SimpleQueue

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from dslkit import garbage
from ezskiros.engine.ahead import Ahead, skills_ahead
from ezskiros.engine.build import root_skill
from ezskiros.engine.depth import deep
from ezskiros.engine.events import Code, Reason
from ezskiros.engine.execution_context import ExecutionContext
from ezskiros.engine.prohibitions import Prohibition
from ezskiros.engine.running import Running, with_values_of_now
from ezskiros.engine.skill import SkillChild
from ezskiros.engine.task import Task
from ezskiros.skills.calls import SkillCall


class Afterwards(enum.Enum):
    """The continuation of a task after a tree."""

    RESUME = "resume"
    """The preempted primitives restart; finished work stays done."""
    RETRY = "retry"
    """The task restarts."""
    REPLAN = "replan"
    """Other skills lead from the current world to the post-conditions of the task."""


@dataclass(frozen=True, eq=False)
class Recovery:
    """A requested tree. The ticking thread calls `done` once, with the result and the reason of a
    failure. A new plan is made `without` some skills.
    """

    call: SkillCall
    afterwards: Afterwards
    done: Callable[[bool, str], None]
    without: tuple[Prohibition, ...] = ()
    _released: threading.Event = field(default_factory=threading.Event, init=False)

    def release(self) -> None:
        """Request the end of only this tree, from any thread. The task continues where it was. A
        tree that has not started never starts.
        """
        self._released.set()

    @property
    def is_released(self) -> bool:
        """True if no rule requests this tree anymore."""
        return self._released.is_set()


def newly_asked(queue: SimpleQueue[Recovery]) -> Iterator[Recovery]:
    """The requests that are still valid. The others are reported as stopped."""
    while True:
        try:
            asked = queue.get_nowait()
        except Empty:
            return
        if asked.is_released:
            asked.done(False, "it was stopped")
        else:
            yield asked


class NoPlanError(Exception):
    """No skills lead to the goal of a task. The text gives the reason."""


PlannedCalls = Sequence[SkillCall]
"""A plan: skills, one after the other."""
Replan = Callable[[SkillCall, Sequence[Prohibition]], "Future[PlannedCalls]"]
"""Searches for a plan from the current world to the post-conditions of a skill whose values are all
given, without the skills that rules always stop. The future raises `NoPlanError`.
"""


class InterruptibleTask(Task):
    """A task, and the tree that interrupts it."""

    def __init__(self, call: SkillCall, execution: ExecutionContext, replan: Replan) -> None:
        super().__init__(call, execution)
        self.begun: Callable[[SkillChild], object] = lambda _: None
        """Called for each tree that replaces another one: recoveries, and skills of a plan."""
        self._call, self._replan = call, replan
        self._aim = call
        self._left: deque[SkillCall] = deque()
        self._asked: SimpleQueue[Recovery] = SimpleQueue()
        self._recovery: Recovery | None = None
        self._tree: SkillChild | None = None
        self._search: Future[PlannedCalls] | None = None
        self._interrupted: list[Running] | None = None

    @property
    def running(self) -> Iterable[Running]:
        """The running skills of the task. While a tree runs instead, and until they run again,
        these are the skills that were running when the tree started.
        """
        return self.execution.running if self._interrupted is None else self._interrupted

    @property
    def recovering(self) -> SkillChild | None:
        """The tree that runs in place of the task; None while the task runs."""
        return self._tree

    @property
    def ahead(self) -> list[Ahead] | None:
        """The skills that can start next; after a tree, those of the task. None if they are
        unknown: before a new plan is found, and with values from a SkiROS2 blackboard. Only the
        ticking thread may call this.
        """
        replans = self._recovery is not None and self._recovery.afterwards is Afterwards.REPLAN
        if self.execution.compatible or replans:
            return None
        own = skills_ahead(self.root, self._left[0] if self._left else None)
        return own if self._tree is None else [*skills_ahead(self._tree), *own]

    def go_by(self, plan: PlannedCalls) -> None:
        """Follow a plan that was made before the first tick, instead of the task's own tree. The
        plan has at least one skill.
        """
        self._left = deque(plan)
        self._start(self._left.popleft())

    def recover(self, recovery: Recovery) -> None:
        """Request a tree, from any thread. A running tree is replaced."""
        self._asked.put(recovery)

    def tick(self) -> Status:
        """Tick the tree if there is one, otherwise the task."""
        with deep():
            self._take()
        if self._search is not None:
            self.ticks += 1
            return self._take_plan(self._search) if self._search.done() else Status.RUNNING
        if self._tree is None:
            return self._tick_task()
        self.ticks += 1
        with deep(), garbage.not_now():
            for _ in self._tree.tick():
                pass
        if self._tree.status is Status.RUNNING:
            return Status.RUNNING
        return self._end(self._tree.status)

    def preempt(self) -> None:
        """Stop the tree and the task."""
        self._give_up("the task is stopped")
        super().preempt()

    def _tick_task(self) -> Status:
        status = super().tick()
        self._interrupted = None
        if status is not Status.SUCCESS or not self._left:
            return status
        self._start(self._left.popleft())
        return Status.RUNNING

    def _take(self) -> None:
        """Begin the last tree that was requested since the tick before. A release ends a tree. A
        search for a plan continues, because the tree has done its work, and the old plan may no
        longer be possible.
        """
        if self._tree is not None and self._recovery is not None and self._recovery.is_released:
            self._give_up("it was stopped")
        for asked in newly_asked(self._asked):
            self._give_up("another tree was requested")
            self._begin(asked)

    def _begin(self, asked: Recovery) -> None:
        self._interrupted = with_values_of_now(self.running)
        for leaf in list(_running_primitives(self.root)):
            leaf.stop(Status.INVALID)
        self._recovery = asked
        self._tree = self._made(asked.call)
        self.begun(self._tree)

    def _give_up(self, why: str) -> None:
        """End the tree, if one runs."""
        tree, recovery = self._tree, self._recovery
        self._tree = self._recovery = self._search = None
        if tree is not None:
            with deep():
                tree.stop(Status.INVALID)
        if recovery is not None:
            recovery.done(False, why)

    def _end(self, status: Status) -> Status:
        """After the tree, continue the task, or let it fail."""
        recovery = self._recovery
        assert recovery is not None, "a tree runs"
        self._tree = None
        if status is not Status.SUCCESS:
            reason = self.execution.last_failure or Reason(Code.EXECUTION, "it failed")
            return self._failed(recovery, f"the recovery has failed: {reason.text}")
        if recovery.afterwards is Afterwards.REPLAN:
            self._search = self._replan(self._goal(), recovery.without)
            return Status.RUNNING
        self._recovery = None
        if recovery.afterwards is Afterwards.RETRY:
            self._left.clear()
            self._stop_task()
            self._start(self._call)
        recovery.done(True, "")
        return Status.RUNNING

    def _goal(self) -> SkillCall:
        """The call of the task, with the values that were found for its parameters."""
        if self.root.call is self._call:
            values = {**self._call.arguments, **self.root.values}
            self._aim = replace(self._call, arguments=values)
        return self._aim

    def _take_plan(self, search: Future[PlannedCalls]) -> Status:
        """Continue the task with another plan. The task is over if its goal is met already."""
        recovery = self._recovery
        assert recovery is not None, "a plan is searched for"
        self._search = None
        try:
            plan = search.result()
        except NoPlanError as problem:
            return self._failed(recovery, f"no plan leads to the goal of the task: {problem}")
        self._recovery = None
        self._stop_task()
        self._left = deque(plan)
        recovery.done(True, "")
        if not self._left:
            return Status.SUCCESS
        self._start(self._left.popleft())
        return Status.RUNNING

    def _start(self, call: SkillCall) -> None:
        self.root = self._made(call)
        self.begun(self.root)

    def _made(self, call: SkillCall) -> SkillChild:
        plan = self.execution.plans.of(call)[0]
        return root_skill(call, self.execution, plan.label or plan.skill.name)

    def _stop_task(self) -> None:
        with deep():
            self.root.stop(Status.INVALID)

    def _failed(self, recovery: Recovery, why: str) -> Status:
        self._recovery = None
        self._stop_task()
        self.execution.last_failure = Reason(Code.EXECUTION, why)
        recovery.done(False, why)
        return Status.FAILURE


def _running_primitives(skill: SkillChild) -> Iterator[SkillChild]:
    """The primitives that run below a skill, or the skill itself."""
    if skill.status is not Status.RUNNING:
        return
    if skill.tree is None:
        yield skill
        return
    waiting: list[Behaviour] = [skill.tree]
    while waiting:
        each = waiting.pop()
        if each.status is not Status.RUNNING:
            continue
        if isinstance(each, SkillChild):
            yield from _running_primitives(each)
        else:
            waiting += reversed(each.children)
