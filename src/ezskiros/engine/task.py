"""A task: one skill that is ticked until it has a result or is stopped."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

from py_trees.common import Status

from dslkit import garbage
from ezskiros.engine.build import root_skill
from ezskiros.engine.depth import deep
from ezskiros.engine.events import Reason
from ezskiros.engine.execution_context import ExecutionContext
from ezskiros.engine.user_code import kept_alive
from ezskiros.skills.calls import SkillCall

PERIOD = 0.04
"""The seconds from tick to tick, as in SkiROS2."""


@dataclass(frozen=True)
class TaskOutcome:
    """The outcome of a task. `reason` gives the reason of a failure."""

    is_success: bool
    ticks: int
    seconds: float
    reason: Reason | None = None


class Task:
    """A skill with the tree below it. `ticks` is the number of its ticks."""

    def __init__(self, call: SkillCall, execution: ExecutionContext) -> None:
        plan = execution.plans.of(call)[0]
        self.execution = execution
        self.ticks = 0
        self.root = root_skill(call, execution, plan.label or plan.skill.name)

    def tick(self) -> Status:
        """Tick once."""
        self.ticks += 1
        with deep(), garbage.not_now():
            for _ in self.root.tick():
                pass
        return self.root.status

    def preempt(self) -> None:
        """Stop the running skills: children first, then `onPreempt` and `onEnd`."""
        with deep():
            self.root.stop(Status.INVALID)


def run(
    task: Task,
    period: float = PERIOD,
    *,
    wait: Callable[[float], object] = time.sleep,
    why_stop: Callable[[], str | None] = lambda: None,
    after_tick: Callable[[], object] = lambda: None,
) -> TaskOutcome:
    """Tick a task once per period until it has a result.

    `why_stop` is called before each tick; if it returns a reason, the task is preempted. `wait`
    waits for some seconds.
    """
    clock = task.execution.clock
    start = clock()
    status, reason = Status.RUNNING, None
    with kept_alive():
        while status is Status.RUNNING:
            if stopped := why_stop():
                reason = Reason(0, stopped)
                task.preempt()
                break
            due = clock() + period
            status = task.tick()
            after_tick()
            if status is Status.RUNNING:
                wait(max(0.0, due - clock()))
    if status is Status.FAILURE:
        reason = task.execution.last_failure
    return TaskOutcome(status is Status.SUCCESS, task.ticks, clock() - start, reason)
