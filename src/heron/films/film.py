"""A film of an episode: what can be seen is kept while it runs, and drawn when it is over."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import Any, NamedTuple

import mujoco
import numpy as np
import OpenGL.error
from numpy.typing import NDArray

from heron.appearance import Moment, Stage, moment_of
from heron.experiments import Node
from heron.experiments.experiment import Camera
from heron.guard import Guard
from heron.robot.physics import Physics
from heron.topics import InProcess

PERIOD_NS = 50_000_000
_TROUBLE = (
    *(AttributeError, ImportError, OSError, RuntimeError, mujoco.FatalError),
    OpenGL.error.Error,
)
"""Errors of OpenGL, of its libraries, and of who looks for them."""
_UNSEEN = 0.0012  # of the distance of the camera: half of a pixel
Pixels = NDArray[np.uint8]
Size = tuple[int, int]
"""Width and height, in pixels."""


class CannotDrawError(RuntimeError):
    """The machine cannot draw; the text is the reason."""


class _Reel(NamedTuple):
    """The moments of one scene."""

    spec: Any
    moments: list[Moment]


class Film:
    """An observer that keeps a moment every `PERIOD_NS`."""

    period_ns = PERIOD_NS

    def __init__(self) -> None:
        self._reels: list[_Reel] = []
        self._physics: Physics | None = None

    def attend(self, physics: Physics, carrier: InProcess, guard: Guard | None) -> Sequence[Node]:  # noqa: ARG002
        """Look on."""
        self._physics = physics
        self._reels.append(_Reel(physics.spec, []))
        return [self]

    def tick(self, now_ns: int) -> None:  # noqa: ARG002
        """Keep what there is to see."""
        assert self._physics is not None
        self._reels[-1].moments.append(moment_of(self._physics.data))

    @property
    def duration(self) -> float:
        """The length of all scenes (s)."""
        return sum(len(reel.moments) for reel in self._reels) * PERIOD_NS * 1e-9

    def pictures(
        self, cameras: Sequence[Camera], times: Sequence[float], size: Size
    ) -> Iterator[Pixels]:
        """Pictures at these times (s), each scene as its camera sees it. After the end the last one
        stays. Raises `CannotDrawError`.
        """
        if not hasattr(mujoco, "GLContext"):
            raise CannotDrawError("there is no EGL")
        for scene, indices in groupby(map(self._place, times), key=lambda place: place[0]):
            reel = self._reels[scene]
            moments = [reel.moments[index] for _, index in indices]
            yield from _drawn(Stage(reel.spec), moments, cameras[scene], size)

    def _place(self, time: float) -> tuple[int, int]:
        """The scene of an instant (s), and the number of its moment there."""
        index = round(time * 1e9 / PERIOD_NS)
        for scene, reel in enumerate(self._reels):
            if index < len(reel.moments):
                return scene, index
            index -= len(reel.moments)
        return len(self._reels) - 1, -1


def _drawn(stage: Stage, moments: Sequence[Moment], camera: Camera, size: Size) -> Iterator[Pixels]:
    """One picture for each moment; what stands still is drawn once."""
    width, height = size
    view = mujoco.MjvCamera()
    view.distance, view.azimuth, view.elevation = camera.distance, camera.azimuth, camera.elevation
    shown = mujoco.MjvOption()
    shown.sitegroup[:] = 0  # marks that only sensors need
    buffer = stage.model.vis.global_
    buffer.offwidth, buffer.offheight = max(width, buffer.offwidth), max(height, buffer.offheight)
    try:
        renderer = mujoco.Renderer(stage.model, height, width)
    except _TROUBLE as error:
        raise CannotDrawError(f"{type(error).__name__}: {error}") from error
    with renderer:
        before, pixels = None, np.zeros((height, width, 3), np.uint8)
        for moment in moments:
            stage.show(moment)
            places = stage.places()
            if before is None or np.abs(places - before).max() > _UNSEEN * camera.distance:
                view.lookat[:] = stage.place_of(camera.body)
                view.lookat[2] += camera.above
                stage.light(view.lookat)
                renderer.update_scene(stage.data, view, shown)
                before, pixels = places, renderer.render().copy()
            yield pixels
