"""The running physics, accessed by names."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from heron.scene.scene import STEP_NS

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Attitude:
    """The orientation of a body (rad)."""

    roll: float
    pitch: float
    yaw: float


class Physics:
    """A scene and its state. `now_ns` is the time in this scene. If an episode continues in another
    scene, the other scene begins at `began_ns` of the episode.
    """

    def __init__(self, spec: Any) -> None:
        self.spec = spec
        self.model = model = spec.compile()
        self.data = mujoco.MjData(model)
        self.now_ns = 0
        self.began_ns = 0
        self._slices = {
            model.sensor(index).name: slice(
                model.sensor_adr[index], model.sensor_adr[index] + model.sensor_dim[index]
            )
            for index in range(model.nsensor)
        }
        mujoco.mj_forward(model, self.data)

    def settle(self, steps: int) -> None:
        """Let all bodies come to rest, before time begins."""
        mujoco.mj_step(self.model, self.data, nstep=steps)

    def step(self) -> None:
        """One step of the physics."""
        mujoco.mj_step(self.model, self.data)
        self.now_ns += STEP_NS

    @property
    def elapsed_ns(self) -> int:
        """The time in the episode."""
        return self.began_ns + self.now_ns

    def geoms(self, bodies: Sequence[str]) -> list[int]:
        """The numbers of the geoms of some bodies."""
        found: list[int] = []
        for name in bodies:
            body = self.model.body(name)
            first = int(body.geomadr[0])
            found += range(first, first + int(body.geomnum[0]))
        return found

    def sensor(self, name: str) -> Floats:
        """The present reading of an ideal sensor; a view that changes with the state."""
        found: Floats = self.data.sensordata[self._slices[name]]
        return found


def attitude(quaternion: Floats) -> Attitude:
    """Roll, pitch and yaw of a quaternion w, x, y, z, as the rules language has them."""
    w, x, y, z = quaternion.tolist()
    return Attitude(
        math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
        math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x)))),
        math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
    )
