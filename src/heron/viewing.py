"""A window on an episode, in real time."""

from __future__ import annotations

import threading
import time
import warnings
from collections.abc import Iterable, Sequence
from typing import Any

import glfw
import mujoco
import mujoco.viewer

from heron.appearance import Camera, Stage, moment_of
from heron.experiments import SimulatedNode
from heron.guard import Guard
from heron.robot.physics import Physics
from heron.topics import InProcess

_PATIENCE_S = 5.0
"""The time that a window may take to close."""


def trouble() -> str | None:
    """The reason why no window can be opened; None if a window can be opened. Call this first:
    MuJoCo would wait for a window forever.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it warns, too
        if glfw.init():
            return None
    found: Any = glfw.get_error()
    return found[1].decode() if found[1] else "no window can be opened"


class Window:
    """An observer that draws the scene 60 times a second. After the user closes the window, the
    episode continues without the window, at full speed. The next camera shows the next scene.
    """

    period_ns = 16_000_000

    def __init__(self, cameras: Iterable[Camera]) -> None:
        self._cameras = iter(cameras)
        self._handle: Any = None
        self._physics: Physics | None = None
        self._stage: Stage | None = None
        self._drawing: list[threading.Thread] = []
        self._began_s = 0.0

    def __enter__(self) -> Window:
        return self

    def __exit__(self, *_: object) -> None:
        """Close the window, and wait for its thread: drawing in a closed window fails."""
        if self._handle is not None:
            self._handle.close()
        for thread in self._drawing:
            thread.join(_PATIENCE_S)

    def attend(
        self,
        physics: Physics,
        carrier: InProcess,  # noqa: ARG002
        guard: Guard | None,  # noqa: ARG002
    ) -> Sequence[SimulatedNode]:
        """Open the window; another scene gets another one."""
        if self._handle is not None:
            if not self._handle.is_running():
                return []
            self.__exit__()
        self._physics, self._stage = physics, Stage(physics.spec)
        self._stage.show(moment_of(physics.data))
        others = threading.enumerate()
        self._handle = mujoco.viewer.launch_passive(
            self._stage.model, self._stage.data, show_left_ui=False, show_right_ui=False
        )
        self._drawing = [each for each in threading.enumerate() if each not in others]
        camera = next(self._cameras, None)
        if camera is not None:
            self._look(self._stage, camera)
        self._began_s = time.monotonic()
        return [self]

    def _look(self, stage: Stage, camera: Camera) -> None:
        """Follow a body, or look at a thing that stands still."""
        with self._handle.lock():
            view = self._handle.cam
            body = mujoco.mj_name2id(stage.model, mujoco.mjtObj.mjOBJ_BODY, camera.body)
            if body >= 0:
                view.type, view.trackbodyid = mujoco.mjtCamera.mjCAMERA_TRACKING, body
            else:
                view.lookat[:] = stage.place_of(camera.body)
            view.distance, view.azimuth = camera.distance, camera.azimuth
            view.elevation = camera.elevation

    def tick(self, now_ns: int) -> None:
        """Show the scene, and wait for the next time."""
        if self._handle.is_running():
            assert self._physics is not None
            assert self._stage is not None
            with self._handle.lock():
                self._stage.show(moment_of(self._physics.data))
            self._handle.sync()
            time.sleep(max(0.0, self._began_s + now_ns * 1e-9 - time.monotonic()))
