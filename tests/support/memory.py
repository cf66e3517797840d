"""The memory of a node in live tests, and its queries by lines of JSON.

It runs with the Python of either generation of ROS and needs no ROS packages.
"""

from __future__ import annotations

import json
import os
import sys
import time
from collections import deque
from typing import Any

NAMESPACE = os.environ.get("ROBOT_NAMESPACE", "")
"""The namespace of the node and of its topics, `/robot1`."""

_OF_ALL = ("/clock", "/diagnostics", "/rosout")


def in_namespace(name: str) -> str:
    """A topic or a service of this robot."""
    return name if name in _OF_ALL else NAMESPACE + name


class Memory:
    """Events with their times, by topic or another name."""

    def __init__(self) -> None:
        self.heard: dict[str, deque[list[Any]]] = {}

    def note(self, name: str, what: object) -> None:
        self.heard.setdefault(name, deque(maxlen=50000)).append([time.time(), what])

    def answer(self, request: dict[str, Any]) -> Any:
        """Answer a request."""
        for name, value in request.get("set", {}).items():
            setattr(self, name, value)
        if "forget" in request:
            self.heard.get(request["forget"], deque()).clear()
        if "heard" in request:
            return list(self.heard.get(request["heard"], ()))
        if "count" in request:
            return len(self.heard.get(request["count"], ()))
        if "last" in request:
            return next(reversed(self.heard.get(request["last"], ())), None)
        return None


def serve(memory: Memory) -> None:
    """Answer each line with a line until there are no more, and end, whatever threads there are."""
    for line in sys.stdin:
        sys.stdout.write(json.dumps(memory.answer(json.loads(line))) + "\n")
        sys.stdout.flush()
    os._exit(0)
