"""Action servers of ROS 1, for skills that real SkiROS2 ticks. Nothing of ROS is imported before a
skill asks for one.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any

from heron.goals import ARM, Goal, Server

_PACKAGE = "heron_msgs"
_ACTIONS = {ARM: "MoveArm"}
_PATIENCE_S = 10.0


class Ros1Servers:
    """The servers whose actions the package `heron_msgs` defines; each has one client."""

    def __init__(self) -> None:
        self._known: dict[str, Server] = {}

    def server(self, name: str) -> Server:
        """A client of an action server. Raises `KeyError` if `heron_msgs` has no action for it."""
        if name not in _ACTIONS:
            raise KeyError(f"{_PACKAGE} has no action for {name}, only for {', '.join(_ACTIONS)}")
        if name not in self._known:
            self._known[name] = Ros1Server(name, _ACTIONS[name])
        return self._known[name]


class Ros1Server:
    """An action server as actionlib reaches it. Its name can be remapped, as names of ROS are."""

    def __init__(self, name: str, action: str) -> None:
        """Raises `ImportError` where rospy, actionlib or the package of the action is missing."""
        messages = importlib.import_module(f"{_PACKAGE}.msg")
        actionlib = importlib.import_module("actionlib")
        self._rospy: Any = importlib.import_module("rospy")
        self._reached = importlib.import_module("actionlib_msgs.msg").GoalStatus.SUCCEEDED
        self._goal: Any = getattr(messages, f"{action}Goal")
        self._client: Any = actionlib.SimpleActionClient(name, getattr(messages, f"{action}Action"))

    def send(self, goal: Goal, done: Callable[[bool], None]) -> None:
        """Send a goal. Another thread calls `done` with the success. If the server is not there
        within 10 s, the goal fails.
        """
        if not self._client.wait_for_server(self._rospy.Duration(_PATIENCE_S)):
            done(False)
            return
        self._client.send_goal(
            self._goal(**goal), done_cb=lambda state, _result: done(state == self._reached)
        )

    def cancel(self) -> None:
        """Give the goal up."""
        self._client.cancel_goal()
