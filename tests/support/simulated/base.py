"""A base with two driven wheels that follows speeds, and what its sensors say of that."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from support.simulated.recording import rounded

STEP = 0.004  # s
GRAVITY = 9.81  # m/s^2


@dataclass(frozen=True)
class Leg:
    """A part of a drive: until an instant (s), the speed (m/s) and turn (rad/s) that are wanted."""

    until: float
    speed: float = 0.0
    turn: float = 0.0


@dataclass(frozen=True)
class Now:
    """The base at an instant."""

    x: float
    y: float
    yaw: float
    speed: float
    turn: float
    acceleration: float

    @property
    def place(self) -> tuple[float, float, float]:
        """The position and orientation of the base."""
        return self.x, self.y, self.yaw


@dataclass(frozen=True)
class Base:
    """A base that starts somewhere (m, m, rad), and drives its legs. `held` are stretches in which
    its wheels do not turn, whatever is wanted.
    """

    legs: Sequence[Leg]
    start: tuple[float, float, float]
    acceleration: float  # m/s^2
    turning: float = 4.0  # rad/s^2
    held: Sequence[tuple[float, float]] = ()

    def wanted(self, t: float) -> Leg:
        """The command at an instant."""
        return next((leg for leg in self.legs if t < leg.until), self.legs[-1])

    def at(self, t: float) -> Now:
        """The base at an instant."""
        return self._track[min(round(t / STEP), len(self._track) - 1)]

    @cached_property
    def _track(self) -> list[Now]:
        x, y, yaw = self.start
        speed = turn = 0.0
        found = []
        for number in range(round(self.legs[-1].until / STEP) + 1):
            t = number * STEP
            leg = self.wanted(t)
            is_held = any(begin <= t < end for begin, end in self.held)
            change = 0.0 if is_held else _towards(speed, leg.speed, self.acceleration * STEP)
            speed = 0.0 if is_held else speed + change
            turn = 0.0 if is_held else turn + _towards(turn, leg.turn, self.turning * STEP)
            found.append(Now(x, y, yaw, speed, turn, change / STEP))
            x += speed * math.cos(yaw) * STEP
            y += speed * math.sin(yaw) * STEP
            yaw += turn * STEP
        return found


def _towards(now: float, wanted: float, most: float) -> float:
    return min(max(wanted - now, -most), most)


# --- what is said of it ----------------------------------------------------------------------


def quaternion(roll: float, pitch: float, yaw: float) -> tuple[float, float, float, float]:
    """A turn about z, then y, then x: its x, y, z and w."""
    cr, sr = math.cos(roll / 2), math.sin(roll / 2)
    cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def turned(path: str, roll: float, pitch: float, yaw: float) -> dict[str, Any]:
    """The fields of an orientation."""
    values = quaternion(roll, pitch, yaw)
    return {
        f"{path}__{axis}": rounded(value, 14) for axis, value in zip("xyzw", values, strict=True)
    }


def odometry(now: Now) -> dict[str, Any]:
    """The fields of a nav_msgs/Odometry, without its header."""
    return {
        "child_frame_id": "base_link",
        "pose__pose__position__x": rounded(now.x),
        "pose__pose__position__y": rounded(now.y),
        **turned("pose__pose__orientation", 0.0, 0.0, now.yaw),
        "twist__twist__linear__x": rounded(now.speed),
        "twist__twist__angular__z": rounded(now.turn),
    }


def imu(
    now: Now, roll: float, pitch: float, jolt: float = 0.0, tumbling: float = 0.0
) -> dict[str, Any]:
    """The fields of a sensor_msgs/Imu that is mounted level: angles in rad, its jolt upwards in
    m/s^2, and how fast it rolls in rad/s.
    """
    return {
        **turned("orientation", roll, pitch, now.yaw),
        "angular_velocity__x": rounded(tumbling),
        "angular_velocity__z": rounded(now.turn),
        "linear_acceleration__x": rounded(now.acceleration - GRAVITY * math.sin(pitch)),
        "linear_acceleration__y": rounded(
            now.speed * now.turn + GRAVITY * math.sin(roll) * math.cos(pitch)
        ),
        "linear_acceleration__z": rounded(GRAVITY * math.cos(roll) * math.cos(pitch) + jolt),
    }


def command(leg: Leg) -> dict[str, Any]:
    """The fields of a geometry_msgs/Twist."""
    return {"linear__x": leg.speed, "angular__z": leg.turn}


def curve(t: float, *points: tuple[float, float]) -> float:
    """A line through points (s, value), level before the first and after the last."""
    return float(np.interp(t, [at for at, _ in points], [value for _, value in points]))
