"""Pictures of a stage."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
import OpenGL.error
from numpy.typing import NDArray

from heron.appearance.stage import Stage

_TROUBLE = (
    *(AttributeError, ImportError, OSError, RuntimeError, mujoco.FatalError),
    OpenGL.error.Error,
)
"""Errors of OpenGL, of its libraries, and of their loaders."""
Pixels = NDArray[np.uint8]
Size = tuple[int, int]
"""Width and height, in pixels."""


class CannotDrawError(RuntimeError):
    """The machine cannot draw; the text is the reason."""


@dataclass(frozen=True)
class Camera:
    """The view of an episode (m, degrees): the camera looks at a body from a distance."""

    body: str
    distance: float
    azimuth: float
    elevation: float
    above: float = 0.0


class Canvas:
    """A renderer of a stage, by a camera. Close it after use."""

    def __init__(self, stage: Stage, camera: Camera, size: Size) -> None:
        """Raises `CannotDrawError`."""
        if not hasattr(mujoco, "GLContext"):
            raise CannotDrawError("there is no EGL")
        self._stage, self._camera = stage, camera
        self._view = mujoco.MjvCamera()
        self._view.distance = camera.distance
        self._view.azimuth, self._view.elevation = camera.azimuth, camera.elevation
        self._shown = mujoco.MjvOption()
        self._shown.sitegroup[:] = 0  # marks that only sensors need
        width, height = size
        buffer = stage.model.vis.global_
        buffer.offwidth = max(width, buffer.offwidth)
        buffer.offheight = max(height, buffer.offheight)
        try:
            self._renderer: Any = mujoco.Renderer(stage.model, height, width)
        except _TROUBLE as error:
            raise CannotDrawError(f"{type(error).__name__}: {error}") from error

    def draw(self) -> Pixels:
        """The state that the stage shows now, of shape (height, width, 3)."""
        stage, camera, view = self._stage, self._camera, self._view
        view.lookat[:] = stage.place_of(camera.body)
        view.lookat[2] += camera.above
        stage.light(view.lookat)
        self._renderer.update_scene(stage.data, view, self._shown)
        self._let_light_through()
        pixels: Pixels = self._renderer.render().copy()
        return pixels

    def _let_light_through(self) -> None:
        """Let transparent parts throw no shadow. Decoration throws no shadow either."""
        scene = self._renderer.scene
        for geom in scene.geoms[: scene.ngeom]:
            if geom.rgba[3] < 1.0:
                geom.category = mujoco.mjtCatBit.mjCAT_DECOR

    def close(self) -> None:
        """Release the renderer."""
        self._renderer.close()
