"""The memories of poses, and their sending (rules R16 and R17)."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field

from rossmarie.ir import Reactions, TaskCommand, TaskCommandKind
from rossmarie.ir.reactions import Memory, Retrace

Pose = tuple[float, ...]


@dataclass
class _Kept:
    """The poses of a memory, the oldest pose first, the instant of the last recording, and whether
    all readings were known at the last evaluation.
    """

    memory: Memory
    users: frozenset[int]
    poses: deque[Pose] = field(default_factory=deque)
    recorded_ns: int = 0
    is_known: bool = False

    def record(self, at_ns: int, pose: Pose) -> None:
        """R16: record a known pose far enough from the last one. If the memory is full, the oldest
        pose is dropped.
        """
        if not self.is_known or not self._is_apart(at_ns, pose):
            return
        if len(self.poses) == self.memory.most:
            self.poses.popleft()
        self.poses.append(pose)
        self.recorded_ns = at_ns

    def _is_apart(self, at_ns: int, pose: Pose) -> bool:
        if not self.poses:
            return True
        last = self.poses[-1]
        x, y, z = (pose[axis] - last[axis] for axis in range(3))
        is_far = x * x + y * y + z * z >= self.memory.apart * self.memory.apart
        return is_far and at_ns - self.recorded_ns >= self.memory.apart_ns and pose != last


class Retracing:
    """All memories of a machine, and the instant at which each retracing task sent its last
    pose.
    """

    def __init__(self, reactions: Reactions) -> None:
        tasks = enumerate(reactions.tasks)
        self._effects = {
            index: task.effect for index, task in tasks if isinstance(task.effect, Retrace)
        }
        self._memories = [
            _Kept(memory, self._users(reactions, index))
            for index, memory in enumerate(reactions.memories)
        ]
        self._sent_ns: dict[int, int] = {}

    def _users(self, reactions: Reactions, memory: int) -> frozenset[int]:
        """The rules that retrace a memory."""
        return frozenset(
            rule
            for rule, plan in enumerate(reactions.plans)
            for task in plan.tasks
            if task in self._effects and self._effects[task].memory == memory
        )

    def set_back(self, by_ns: int) -> None:
        """R14: set all instants back."""
        self._sent_ns = {task: sent_ns - by_ns for task, sent_ns in self._sent_ns.items()}
        for kept in self._memories:
            kept.recorded_ns -= by_ns

    def record(self, at_ns: int, engaged: Sequence[bool], readings: Sequence[float]) -> None:
        """R16: record a pose, except while a rule that retraces the memory is carried out."""
        for kept in self._memories if readings else ():
            pose = tuple(readings[each] for each in kept.memory.readings)
            kept.is_known = all(map(math.isfinite, pose))
            if not any(engaged[rule] for rule in kept.users):
                kept.record(at_ns, pose)

    def begin(self, task: int) -> None:
        """Begin a task. Its first pose is due at once."""
        self._sent_ns.pop(task, None)

    def task_commands(self, at_ns: int, holding: Sequence[int]) -> list[TaskCommand]:
        """R17: the pose that each task in force sends now."""
        found = []
        for task in holding:
            due_ns = self._due_ns(task)
            if due_ns is not None and due_ns <= at_ns:
                pose = self._memories[self._effects[task].memory].poses.pop()
                self._sent_ns[task] = at_ns
                found.append(TaskCommand(TaskCommandKind.RETRACE, task, pose=pose))
        return found

    def wakes(self, holding: Sequence[int]) -> list[int]:
        """R13: the instants at which the tasks in force send next."""
        due = (self._due_ns(task) for task in holding)
        return [each for each in due if each is not None]

    def _due_ns(self, task: int) -> int | None:
        """The instant from which a task may send its next pose; None if there is no pose, or if the
        robot's position is unknown.
        """
        effect = self._effects.get(task)
        kept = None if effect is None else self._memories[effect.memory]
        if effect is None or kept is None or not kept.poses or not kept.is_known:
            return None
        sent_ns = self._sent_ns.get(task)
        return -(2**63) if sent_ns is None else sent_ns + effect.period_ns
