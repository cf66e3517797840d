"""The messages of the rover, as ROS has them. Do not change this file."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass
class Quaternion:
    x: float
    y: float
    z: float
    w: float

    def roll(self) -> float:
        """Rotation about the x axis in rad."""
        sine = 2 * (self.w * self.x + self.y * self.z)
        cosine = 1 - 2 * (self.x * self.x + self.y * self.y)
        return math.atan2(sine, cosine)

    def pitch(self) -> float:
        """Rotation about the y axis in rad."""
        return math.asin(max(-1.0, min(1.0, 2 * (self.w * self.y - self.z * self.x))))


@dataclass
class Imu:
    orientation: Quaternion


@dataclass
class Vector3:
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0


@dataclass
class Twist:
    linear: Vector3


@dataclass
class TwistWithCovariance:
    twist: Twist


@dataclass
class Odometry:
    twist: TwistWithCovariance


@dataclass
class Range:
    range: float
