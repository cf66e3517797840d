"""A window on an episode, in real time."""

from __future__ import annotations

import time
import warnings
from collections.abc import Sequence
from typing import Any

import glfw
import mujoco.viewer

from heron.experiments import Node
from heron.guard import Guard
from heron.robot.physics import Physics
from heron.topics import InProcess


def trouble() -> str | None:
    """Why no window can be opened here. To be asked first: MuJoCo would wait for one forever."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it warns, too
        if glfw.init():
            return None
    found: Any = glfw.get_error()
    return found[1].decode() if found[1] else "no window can be opened"


class Window:
    """An observer that shows what there is 60 times a second. Whoever closes the window lets the
    episode go on without it, as fast as it can.
    """

    period_ns = 16_000_000

    def __init__(self) -> None:
        self._handle: Any = None
        self._began_s = 0.0

    def attend(self, physics: Physics, carrier: InProcess, guard: Guard | None) -> Sequence[Node]:  # noqa: ARG002
        """Open the window; another scene gets another one."""
        if self._handle is not None:
            if not self._handle.is_running():
                return []
            self._handle.close()
        self._handle = mujoco.viewer.launch_passive(physics.model, physics.data)
        self._began_s = time.monotonic()
        return [self]

    def tick(self, now_ns: int) -> None:
        """Show it, and wait for the time to come."""
        if self._handle.is_running():
            self._handle.sync()
            time.sleep(max(0.0, self._began_s + now_ns * 1e-9 - time.monotonic()))
