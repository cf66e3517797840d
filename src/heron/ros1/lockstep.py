"""Tell that the node on guard has heard all, and that what it said of that has come.

roscpp looks at its connections turn by turn, and what came in goes into a queue: so a call of a
service should be answered after all that had come before the turn of an earlier call. What the node
says goes out at the beginning of a turn: so it should have come, two calls later. Nothing promises
that, and on a busy machine a message can still come an exchange later. Loggers are seen to by the
thread that hears /clock, and everything else by the one of the node.
"""

from __future__ import annotations

from heron.ros1.node import Node, text

_CALLS_TO_HEAR = 2
_CALLS_TO_ANSWER = 5  # to hear, to let time pass, and to say what follows
_NOTHING_NEW = text("ros.heron") + text("info")  # of a logger that nobody uses


class Lockstep:
    """With a node that was generated for rules, by its name. Raises `Ros1Error` when it is gone."""

    def __init__(self, node: Node, name: str) -> None:
        self._time = node.service(f"{name}/set_logger_level")
        self._rest = node.service(f"{name}/why")

    def wait_for_time(self) -> None:
        """It knows which time it is."""
        for _ in range(_CALLS_TO_HEAR):
            self._time.call(_NOTHING_NEW)

    def wait_for_all(self) -> None:
        """It has heard all, and what it said has come to this process."""
        for _ in range(_CALLS_TO_ANSWER):
            self._rest.call()

    def close(self) -> None:
        """The end of it."""
        self._time.close()
        self._rest.close()
