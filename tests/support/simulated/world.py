"""A flat world: walls and round obstacles, and what a lidar sees of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Wall:
    """A wall from a place to another (m)."""

    x1: float
    y1: float
    x2: float
    y2: float

    def seen(self, x: float, y: float, angles: Floats) -> Floats:
        """The distance in each direction (m); inf in directions that miss the wall."""
        along_x, along_y = np.cos(angles), np.sin(angles)
        wall_x, wall_y = self.x2 - self.x1, self.y2 - self.y1
        away_x, away_y = self.x1 - x, self.y1 - y
        with np.errstate(divide="ignore", invalid="ignore"):
            cross = along_x * wall_y - along_y * wall_x
            distance = (away_x * wall_y - away_y * wall_x) / cross
            share = (away_x * along_y - away_y * along_x) / cross
        is_hit = (distance > 0) & (share >= 0) & (share <= 1)
        return np.where(is_hit, distance, np.inf)


@dataclass(frozen=True)
class Pillar:
    """An obstacle with a round outline: a pole, a leg, a person."""

    x: float
    y: float
    radius: float

    def seen(self, x: float, y: float, angles: Floats) -> Floats:
        """The distance in each direction (m); inf in directions that miss the pillar."""
        away_x, away_y = self.x - x, self.y - y
        ahead = away_x * np.cos(angles) + away_y * np.sin(angles)
        squared = self.radius**2 - (away_x**2 + away_y**2 - ahead**2)
        distance = ahead - np.sqrt(np.maximum(squared, 0.0))
        return np.where((squared >= 0) & (distance > 0), distance, np.inf)


Obstacle = Wall | Pillar


def room(x1: float, y1: float, x2: float, y2: float) -> list[Obstacle]:
    """The walls of a box."""
    corners = [(x1, y1), (x2, y1), (x2, y2), (x1, y2)]
    return [
        Wall(*one, *next_) for one, next_ in zip(corners, [*corners[1:], corners[0]], strict=True)
    ]


@dataclass(frozen=True)
class Lidar:
    """A lidar: its beams (rad, in its own frame), its reach (m), and where it is on its base."""

    angles: Floats
    least: float
    most: float
    x: float = 0.0
    yaw: float = 0.0
    is_upside_down: bool = False
    nothing: float = np.inf
    """The reading of a beam that comes back from nowhere."""
    steps: int = 128
    """Steps of its readings in a meter."""

    def scan(self, base: tuple[float, float, float], obstacles: Sequence[Obstacle]) -> Floats:
        """Its readings, where its base is at a place (m) and turned (rad)."""
        x, y, yaw = base
        at_x, at_y = x + self.x * np.cos(yaw), y + self.x * np.sin(yaw)
        sign = -1.0 if self.is_upside_down else 1.0
        directions = sign * self.angles + self.yaw + yaw
        seen = np.min([obstacle.seen(at_x, at_y, directions) for obstacle in obstacles], axis=0)
        is_in_reach = (seen >= self.least) & (seen <= self.most)
        steps = np.rint(np.where(is_in_reach, seen, 0.0) * self.steps)
        return np.where(is_in_reach, steps / self.steps, self.nothing)

    def fields(self, ranges: Floats, period: float) -> dict[str, object]:
        """The fields of a sensor_msgs/LaserScan."""
        return {
            "angle_min": float(self.angles[0]),
            "angle_max": float(self.angles[-1]),
            "angle_increment": float(self.angles[1] - self.angles[0]),
            "time_increment": period / len(self.angles),
            "scan_time": period,
            "range_min": self.least,
            "range_max": self.most,
            "ranges": ranges,
        }
