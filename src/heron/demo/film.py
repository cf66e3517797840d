"""A film of an episode: states are kept while it runs, and drawn when it is over."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from heron.experiments import Node
from heron.experiments.table import Camera
from heron.guard import Guard
from heron.robot.physics import Physics
from heron.topics import InProcess

PERIOD_NS = 100_000_000
_MOST = 140
_WIDTH, _HEIGHT = 480, 270
_QUALITY = 72
_SKY = (228, 233, 238)
_STATE = mujoco.mjtState.mjSTATE_INTEGRATION


@dataclass(frozen=True)
class Frames:
    """Pictures (WebP) at equal distances (s); none, and why, where nothing can be drawn."""

    pictures: tuple[bytes, ...]
    period: float
    trouble: str = ""


class _Reel(NamedTuple):
    """What was kept of one scene."""

    physics: Physics
    states: list[NDArray[np.float64]]


class Film:
    """An observer that keeps a state every `PERIOD_NS`."""

    period_ns = PERIOD_NS

    def __init__(self) -> None:
        self._reels: list[_Reel] = []

    def attend(self, physics: Physics, carrier: InProcess, guard: Guard | None) -> Sequence[Node]:  # noqa: ARG002
        """Look on."""
        self._reels.append(_Reel(physics, []))
        return [self]

    def tick(self, now_ns: int) -> None:  # noqa: ARG002
        """Keep the state."""
        physics, states = self._reels[-1]
        state = np.empty(mujoco.mj_stateSize(physics.model, _STATE))
        mujoco.mj_getState(physics.model, physics.data, state, _STATE)
        states.append(state)

    def develop(self, cameras: Sequence[Camera]) -> Frames:
        """Draw it, each scene as its camera sees it."""
        stride = -(-sum(len(reel.states) for reel in self._reels) // _MOST)
        period = stride * PERIOD_NS * 1e-9
        if not hasattr(mujoco, "GLContext"):
            return Frames((), period, "there is no EGL")
        try:
            pictures = list(self._drawn(cameras, stride))
        except Exception as error:  # OpenGL fails in many ways, and a demo goes on without pictures
            return Frames((), period, f"{type(error).__name__}: {error}")
        return Frames(tuple(pictures), period)

    def _drawn(self, cameras: Sequence[Camera], stride: int) -> Iterator[bytes]:
        """Of all states together, each `stride`-th."""
        skipped = 0
        for (physics, states), camera in zip(self._reels, cameras, strict=False):
            yield from _draw(physics.model, states[skipped::stride], camera)
            skipped = (skipped - len(states)) % stride


def _draw(
    model: mujoco.MjModel, states: Sequence[NDArray[np.float64]], camera: Camera
) -> list[bytes]:
    _light(model)
    data = mujoco.MjData(model)
    view = mujoco.MjvCamera()
    view.distance, view.azimuth, view.elevation = camera.distance, camera.azimuth, camera.elevation
    shown = mujoco.MjvOption()
    shown.sitegroup[:] = 0  # marks that only sensors need
    with mujoco.Renderer(model, _HEIGHT, _WIDTH) as renderer:
        renderer.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = False  # slow in software
        renderer.scene.flags[mujoco.mjtRndFlag.mjRND_REFLECTION] = False
        pictures = []
        for state in states:
            mujoco.mj_setState(model, data, state, _STATE)
            mujoco.mj_forward(model, data)
            view.lookat[:] = _middle(model, data, camera.body)
            renderer.update_scene(data, view, shown)
            pictures.append(_encoded(renderer.render()))
    return pictures


def _middle(model: mujoco.MjModel, data: mujoco.MjData, name: str) -> NDArray[np.float64]:
    """Where a body is, or a part of one."""
    found: NDArray[np.float64]
    if mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name) >= 0:
        found = data.body(name).xpos
    else:
        found = data.geom(name).xpos
    return found


def _light(model: mujoco.MjModel) -> None:
    """Even light. The physics is over: only pictures are made of this model."""
    model.light_type[:] = mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
    model.light_diffuse[:] = 0.45
    model.light_dir[:] = (0.4, 0.3, -1.0)
    model.vis.headlight.ambient[:] = 0.3
    model.vis.headlight.diffuse[:] = 0.2
    model.vis.headlight.specular[:] = 0.0
    model.vis.quality.offsamples = 4


def _encoded(pixels: NDArray[np.uint8]) -> bytes:
    shown = pixels.copy()
    shown[(pixels == 0).all(axis=2)] = _SKY  # nothing that is lit is black
    file = io.BytesIO()
    Image.fromarray(shown).save(file, "webp", quality=_QUALITY)
    return file.getvalue()
