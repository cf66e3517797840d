"""Primitive skills reach the robot by the carrier of whoever ticks them."""

from __future__ import annotations

from contextvars import ContextVar

from heron.goals import Goal, Servers

CARRIER: ContextVar[Servers] = ContextVar("carrier")


class Sent:
    """A goal that was sent to an action server. `is_reached` is None as long as nobody knows."""

    def __init__(self, server: str, goal: Goal) -> None:
        self._server = CARRIER.get().server(server)
        self.is_reached: bool | None = None
        self._server.send(goal, self._end)

    def cancel(self) -> None:
        """Give it up."""
        self._server.cancel()

    def _end(self, is_reached: bool) -> None:
        self.is_reached = is_reached
