"""The main loop: run all programs that are due, then advance the physics by one step."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol, runtime_checkable

from heron.robot.physics import Physics


class SimulatedNode(Protocol):
    """Something that has its turn again and again; `period_ns` is a multiple of the step."""

    @property
    def period_ns(self) -> int:
        """The time between two turns."""

    def tick(self, now_ns: int) -> None:
        """Its turn."""


@runtime_checkable
class Waiting(Protocol):
    """A node that knows when its next turn is worth anything: not before `due_ns`."""

    due_ns: int


class Turns:
    """The turns of the nodes. Nodes with the same instant take their turns in the order of the
    nodes.
    """

    def __init__(self, physics: Physics, nodes: Sequence[SimulatedNode]) -> None:
        self._physics = physics
        self._turns = [
            (node.tick, node.period_ns, node if isinstance(node, Waiting) else None)
            for node in nodes
        ]

    def step(self) -> None:
        """Run all programs that are due, then advance the physics by one step."""
        now_ns = self._physics.now_ns
        for tick, period_ns, waiting in self._turns:
            if now_ns % period_ns == 0 and (waiting is None or now_ns >= waiting.due_ns):
                tick(now_ns)
        self._physics.step()


def run(
    physics: Physics, nodes: Sequence[SimulatedNode], until_ns: int, is_over: Callable[[], bool]
) -> None:
    """Let time pass."""
    step = Turns(physics, nodes).step
    while physics.now_ns < until_ns and not is_over():
        step()
