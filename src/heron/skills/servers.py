"""The interface between primitive skills and the robot: the caller of a tick sets the carrier."""

from __future__ import annotations

from contextvars import ContextVar

from heron.goals import Goal, Servers
from heron.skills.ros1_servers import Ros1Servers

_ROS1 = Ros1Servers()
CARRIER: ContextVar[Servers] = ContextVar("carrier", default=_ROS1)
"""SkiROS2 sets no carrier: its skills use the action servers of ROS 1."""


class SentGoal:
    """A goal that was sent to an action server. `is_reached` is None until the server answers."""

    def __init__(self, server: str, goal: Goal) -> None:
        self._server = CARRIER.get().server(server)
        self.is_reached: bool | None = None
        self._server.send(goal, self._end)

    def cancel(self) -> None:
        """Cancel the goal."""
        self._server.cancel()

    def _end(self, is_reached: bool) -> None:
        self.is_reached = is_reached
