"""Detection that the guard node has received all messages, and that its replies have arrived.

roscpp polls its connections in turns and queues incoming messages. So a service call should be
answered after all messages that arrived before the turn of an earlier call. The messages of the
node leave at the beginning of a turn, so they should have arrived two calls later. This order is
not guaranteed: on a busy machine a message can still arrive one exchange later. The thread that
receives /clock serves loggers; the thread of the node serves everything else.
"""

from __future__ import annotations

from heron.ros1.node import Ros1Node, text

_CALLS_TO_HEAR = 2
_CALLS_TO_ANSWER = 5  # to hear, to let time pass, and to say what follows
_NOTHING_NEW = text("ros.heron") + text("info")  # of an unused logger


class Lockstep:
    """With a node that was generated for rules, by its name. Raises `Ros1Error` when it is gone."""

    def __init__(self, node: Ros1Node, name: str) -> None:
        self._time = node.service(f"{name}/set_logger_level")
        self._rest = node.service(f"{name}/why")

    def wait_for_time(self) -> None:
        """It knows which time it is."""
        for _ in range(_CALLS_TO_HEAR):
            self._time.call(_NOTHING_NEW)

    def wait_for_all(self) -> None:
        """The node has received all messages, and its messages have arrived in this process."""
        for _ in range(_CALLS_TO_ANSWER):
            self._rest.call()

    def close(self) -> None:
        """Close the lockstep."""
        self._time.close()
        self._rest.close()
