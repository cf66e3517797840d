"""Action servers of the robot, and goals for them: all that its skills know of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

NAVIGATE = "/navigate"
"""The action server of the base: it drives along its route to a place."""

ARM = "/arm"
"""The action server of the arm: it carries what it holds, places it, and retracts."""

Scalar = bool | float | str
Goal = Mapping[str, Scalar]
"""The fields of a goal, by name."""


class Server(Protocol):
    """An action server: it has one goal at a time."""

    def send(self, goal: Goal, done: Callable[[bool], None]) -> None:
        """A new goal takes the place of the one at hand; `done` hears whether it was reached."""

    def cancel(self) -> None:
        """The goal at hand, if there is one, is given up; `done` hears of that."""


class Servers(Protocol):
    """Whoever knows the action servers by their names."""

    def server(self, name: str) -> Server:
        """An action server. Raises `KeyError` if it is not there."""
