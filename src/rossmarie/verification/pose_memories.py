"""Memories of poses, the tasks that retrace them, and the places of their numbers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rossmarie.ir import reactions


@dataclass(frozen=True)
class Memory:
    """A memory of poses, the index at which its numbers begin, and the rules that retrace it."""

    index: int
    first: int
    memory: reactions.Memory
    rules: tuple[int, ...]

    @property
    def numbers(self) -> range:
        """The numbers of each pose."""
        return range(len(self.memory.readings))

    @property
    def end(self) -> int:
        """The end of its numbers."""
        return self.first + self.memory.most * len(self.memory.readings)

    def pose(self, reactor: str, place: str) -> str:
        """The index of the first number of the pose at a place. The oldest pose has place 0."""
        turned = f"({reactor}poses_oldest[{self.index}] + {place}) % {self.memory.most}u"
        return f"{self.first}u + {turned} * {len(self.numbers)}u"


def retraces_of(found: reactions.Reactions) -> tuple[tuple[int, reactions.Retrace], ...]:
    """The tasks that retrace poses, with their indexes."""
    return tuple(
        (task, each.effect)
        for task, each in enumerate(found.tasks)
        if isinstance(each.effect, reactions.Retrace)
    )


def memories_of(found: reactions.Reactions) -> Iterator[Memory]:
    """All memories, in their order in the reactor."""
    first = 0
    for index, memory in enumerate(found.memories):
        tasks = {task for task, effect in retraces_of(found) if effect.memory == index}
        rules = tuple(r for r, plan in enumerate(found.plans) if tasks & set(plan.tasks))
        placed = Memory(index, first, memory, rules)
        yield placed
        first = placed.end
