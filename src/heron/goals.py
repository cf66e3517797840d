"""Action servers of the robot and their goals, the only interface of its skills to the robot."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

NAVIGATE = "/navigate"
"""The action server of the base: it drives along its route to a place."""

LOOK_OUT = "/look_out"
"""The action server that waits until the path ahead of the base is free."""

ARM = "/arm"
"""The action server of the arm: it carries the load, places it, and retracts."""

RECOVERY = "/recovery"
"""The action server of a task: it runs a behavior tree instead of the task."""

Scalar = bool | float | str
Value = Scalar | tuple[Scalar, ...]
Goal = Mapping[str, Value]
"""The fields of a goal, by name."""


def number_in(goal: Goal, name: str) -> float:
    """A number of a goal; 0 if it has none there, as in ROS."""
    value = goal.get(name, 0.0)
    return float(value) if isinstance(value, int | float) else 0.0


class Server(Protocol):
    """An action server: it has one goal at a time."""

    def send(self, goal: Goal, done: Callable[[bool], None]) -> None:
        """Replace the current goal by a new goal. `done` is called with the success of the new
        goal.
        """

    def cancel(self) -> None:
        """The goal at hand, if there is one, is given up; `done` hears of that."""


class Servers(Protocol):
    """A collection of action servers by their names."""

    def server(self, name: str) -> Server:
        """An action server. Raises `KeyError` if it is not there."""
