"""An arm that moves from posture to posture, and what is said of its joints."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from support.simulated.recording import rounded

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Motion:
    """Postures (rad) at instants (s): in between, the joints speed up and slow down smoothly."""

    postures: Sequence[tuple[float, Sequence[float]]]

    def positions(self, t: float) -> Floats:
        """The positions of the joints (rad)."""
        begin, end, share, _ = self._part(t)
        return begin + (end - begin) * (share - math.sin(2 * math.pi * share) / (2 * math.pi))

    def velocities(self, t: float) -> Floats:
        """The velocities of the joints (rad/s)."""
        begin, end, share, seconds = self._part(t)
        return (end - begin) * (1 - math.cos(2 * math.pi * share)) / seconds

    def _part(self, t: float) -> tuple[Floats, Floats, float, float]:
        """The posture before and after an instant, the share of the way in time, and that time."""
        pairs = zip(self.postures, self.postures[1:], strict=False)
        for (begin, one), (end, other) in pairs:
            if begin <= t < end:
                return np.array(one), np.array(other), (t - begin) / (end - begin), end - begin
        rest = np.array(self.postures[0 if t < self.postures[0][0] else -1][1])
        return rest, rest, 0.0, 1.0


def joint_state(
    names: Sequence[str],
    motion: Motion,
    t: float,
    efforts: Sequence[float],
    path: str = "",
    order: Sequence[int] = (),
) -> dict[str, Any]:
    """The fields of a sensor_msgs/JointState, which may be a field of another message. `order` are
    the joints in the order in which they are reported, if that is another one.
    """
    reported = list(order or range(len(names)))
    positions, velocities = motion.positions(t), motion.velocities(t)
    return {
        f"{path}name": [names[each] for each in reported],
        f"{path}position": [rounded(positions[each], 12) for each in reported],
        f"{path}velocity": [rounded(velocities[each]) for each in reported],
        f"{path}effort": [rounded(efforts[each], 6) for each in reported],
    }


# --- where the hand is -----------------------------------------------------------------------


def about_x(angle: float) -> Floats:
    """A turn about x."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]])


def about_z(angle: float) -> Floats:
    """A turn about z."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


def moved(x: float, z: float) -> Floats:
    """A way along x and z."""
    found = np.eye(4)
    found[0, 3], found[2, 3] = x, z
    return found


def pose(place: Floats, path: str = "") -> dict[str, Any]:
    """The fields of a geometry_msgs/PoseStamped, without its header."""
    x, y, z, w = _quaternion(place[:3, :3])
    return {
        **{
            f"{path}pose__position__{axis}": rounded(place[i, 3], 12)
            for i, axis in enumerate("xyz")
        },
        f"{path}pose__orientation__x": rounded(x, 14),
        f"{path}pose__orientation__y": rounded(y, 14),
        f"{path}pose__orientation__z": rounded(z, 14),
        f"{path}pose__orientation__w": rounded(w, 14),
    }


def _quaternion(turn: Floats) -> tuple[float, float, float, float]:
    """One of the two quaternions of a turn: the longest row of its products, x, y, z and w."""
    xx, yy, zz = turn[0, 0], turn[1, 1], turn[2, 2]
    products = np.array(
        [
            [
                1 + xx - yy - zz,
                turn[0, 1] + turn[1, 0],
                turn[0, 2] + turn[2, 0],
                turn[2, 1] - turn[1, 2],
            ],
            [
                turn[0, 1] + turn[1, 0],
                1 - xx + yy - zz,
                turn[1, 2] + turn[2, 1],
                turn[0, 2] - turn[2, 0],
            ],
            [
                turn[0, 2] + turn[2, 0],
                turn[1, 2] + turn[2, 1],
                1 - xx - yy + zz,
                turn[1, 0] - turn[0, 1],
            ],
            [
                turn[2, 1] - turn[1, 2],
                turn[0, 2] - turn[2, 0],
                turn[1, 0] - turn[0, 1],
                1 + xx + yy + zz,
            ],
        ]
    )
    row = products[int(np.argmax(np.diag(products)))]
    x, y, z, w = (float(each) for each in row / np.linalg.norm(row))
    return x, y, z, w
