"""The tables of the reactor in `reactor.c`, and what holds of it after each call, however it got
there, by docs/explanation/reactions.md.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

IDLE, RUNNING, HOLDING, WAITING, DONE, FAILED, OVERDUE = range(7)
START, STOP, OVERRULED, FAIL = range(4)
NEVER = 2**63 - 1


@dataclass(frozen=True)
class Task:
    """A task: its rule, how long its end is awaited, the resource, what it does to that."""

    rule: int
    timeout_ns: int | None = None
    resource: int | None = None
    deed: int | None = None
    waits: bool = False


TASKS = (
    Task(0, None, 0, 0, waits=True),
    Task(0, 400),
    Task(0),
    Task(1, 300, 1, None, waits=True),
    Task(1, None, 0, 0, waits=True),
    Task(1),
    Task(2, 500, 0, None, waits=True),
    Task(2),
    Task(3, None, 1, 1),
)
RULES = 4
CLAIMS = {0: ((2, None), (0, 0), (1, 0)), 1: ((1, None), (3, 1))}
"""The tasks that may claim each resource by priority, and the command of each on a single resource.
"""
STAGES = (1, 2, 2, 1)
LIMITS = ((2, 0, -0.2, 0.2, 0.3), (2, 2, -1.0, 1.0, 0.0), (7, 0, -0.1, 0.5, 1e9))
"""Task, field, least, greatest, and how fast that fades."""
FIELDS = 3
SCALE = (5, 0.5, 0.1)


@dataclass(frozen=True)
class Stand:
    """The state of a reactor."""

    now_ns: int
    next_wake_ns: int
    since_ns: Sequence[int]
    bounds: Sequence[tuple[float, float, float]]
    bounded: Sequence[float]
    state: Sequence[int]
    engaged: Sequence[int]
    stage: Sequence[int]


class Reactor:
    """A reactor as it is known from outside: the rules that are to be carried out, the tasks that
    are performed.
    """

    def __init__(self) -> None:
        self.performed: set[int] = set()
        self.is_open = False
        self.goes_on = [False] * RULES

    def react(self, active: int, exempted: int) -> None:
        """Rules become active, or are exempted; the last one yields to the third."""
        engages = [bool(active >> rule & 1 and not exempted >> rule & 1) for rule in range(RULES)]
        self.goes_on = [*engages[:3], engages[3] and not engages[2]]

    def take(self, task_commands: Sequence[tuple[int, int, int]]) -> None:
        """Follow the task commands of a call. Raises AssertionError for one that makes no sense."""
        for task, command, by_rule in task_commands:
            assert 0 <= task < len(TASKS), task
            assert (by_rule >= 0) == (command == OVERRULED), (task, command, by_rule)
            if command == START:
                assert task not in self.performed, f"task {task} starts twice"
                self.performed.add(task)
            else:
                assert command != STOP or task in self.performed, f"task {task} was not started"
                self.performed.discard(task)
        twice = [
            task
            for task, _, _ in task_commands
            if sum(task == other for other, _, _ in task_commands) > 2
        ]
        assert not twice, f"more than two task commands for {twice}"

    def check(self, stand: Stand, t_ns: int, numbers: Sequence[float]) -> None:
        """Compare with how the reactor says that it stands. Raises AssertionError."""
        assert [bool(each) for each in stand.engaged] == self.goes_on, "other rules are engaged"
        for index, task in enumerate(TASKS):
            self._check_task(stand, index, task)
        self.performed -= {index for index, state in enumerate(stand.state) if state == DONE}
        for rule, stage in enumerate(stand.stage):
            assert stage <= STAGES[rule], f"rule {rule} is at stage {stage}"
        dues = [due for due in map(_due, TASKS, stand.state, stand.since_ns) if due > stand.now_ns]
        assert stand.next_wake_ns == min(dues, default=NEVER), "the next wake is another one"
        wanted = self._bounds(stand, t_ns)
        assert [tuple(each) for each in stand.bounds] == wanted, f"{stand.bounds}, not {wanted}"
        for (factor, low, high), x, found in zip(wanted, numbers, stand.bounded, strict=False):
            assert found == _bounded(x, factor, low, high), f"{x} became {found}"

    def _check_task(self, stand: Stand, index: int, task: Task) -> None:
        state = stand.state[index]
        is_in_force = state in (RUNNING, HOLDING)
        owner = self._owner(task)
        assert state in range(7), state
        assert self.goes_on[task.rule] or state == IDLE, f"task {index} goes on without its rule"
        assert not is_in_force or index in self.performed, f"task {index} was not started"
        assert index not in self.performed or is_in_force or state == DONE, f"task {index} goes on"
        assert not is_in_force or owner is None, f"task {index} has what rule {owner} needs"
        assert state not in (WAITING, OVERDUE) or owner is not None, (
            f"task {index} waits for nobody"
        )
        assert state != RUNNING or _due(task, state, stand.since_ns[index]) > stand.now_ns

    def _owner(self, task: Task) -> int | None:
        """The rule that has what a task needs, if it is another one."""
        if task.resource is None:
            return None
        for rule, deed in CLAIMS[task.resource]:
            if self.goes_on[rule]:
                is_shared = task.deed is not None and deed == task.deed and task.timeout_ns is None
                return None if rule == task.rule or is_shared else rule
        return None

    def _bounds(self, stand: Stand, t_ns: int) -> list[tuple[float, float, float]]:
        if not self.is_open or not -(2**61) < t_ns < 2**62:
            return [(1.0, 0.0, 0.0)] * FIELDS
        task, scale, ramp = SCALE
        factor = min(1.0, scale + _moved(stand, task, ramp, t_ns))
        found = [(factor, -math.inf, math.inf)] * FIELDS
        for task, field, least, greatest, ramp in LIMITS:
            moved = _moved(stand, task, ramp, t_ns)
            _, low, high = found[field]
            found[field] = (factor, max(low, least - moved), min(high, greatest + moved))
        return found


def _due(task: Task, state: int, since_ns: int) -> int:
    is_open = state in (RUNNING, WAITING)
    return since_ns + task.timeout_ns if is_open and task.timeout_ns is not None else NEVER


def _moved(stand: Stand, task: int, ramp: float, t_ns: int) -> float:
    """The value of a limit on its ramp after it was lifted."""
    if stand.state[task] == HOLDING:
        return 0.0
    since_ns = stand.since_ns[task]
    if since_ns == NEVER or ramp == 0.0:
        return math.inf
    return ramp * (max(0, t_ns - since_ns) / 1e9)


def _bounded(x: float, factor: float, low: float, high: float) -> float:
    return min(max(x * factor, low), high) if math.isfinite(x) else 0.0
