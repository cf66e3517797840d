"""Observers of an episode, which change nothing: recorders, films, windows."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from heron.experiments.runner import SimulatedNode
from heron.guard import Guard
from heron.robot.physics import Physics
from heron.topics import InProcess


class Observer(Protocol):
    """An observer. It is called when the robot stands ready before time begins, and again when the
    episode continues in another scene.
    """

    def attend(
        self, physics: Physics, carrier: InProcess, guard: Guard | None
    ) -> Sequence[SimulatedNode]:
        """The nodes that have their turn after all others."""


def attended(
    observers: Sequence[Observer], physics: Physics, carrier: InProcess, guard: Guard | None
) -> list[SimulatedNode]:
    """The nodes of all observers."""
    return [node for one in observers for node in one.attend(physics, carrier, guard)]
