"""Heron drives over a bump and a slope to a table, where its arm places a block, and a person comes
near: 60 s. The physics of Heron in MuJoCo would fill a file twenty times as large.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from rossmarie.driver.robots import robot
from support.simulated.base import Base, Leg, curve
from support.simulated.frames import Frame
from support.simulated.mobile import driving
from support.simulated.motion import Motion, joint_state
from support.simulated.recording import Sensor, during, every, rounded, store_of
from support.simulated.troubles import Scanner, Tipping
from support.simulated.world import Lidar, Obstacle, Pillar, room

SECONDS = 60.0
CROSSING = (4.0, 7.0)  # somebody crosses its way
BUMP = (7.0, 7.4)
SLOPE = (9.0, 12.0)
SPEEDING = (13.0, 16.0)
SILENT = (17.0, 17.8)  # the scanner
HAMMERING = (22.0, 23.5)  # the block on the table
TOUCHING = (25.0, 26.0)
CLAMPING = (26.5, 26.7)
TWISTING = (27.0, 27.4)
OVERLOAD = (28.0, 31.0)
NUMB = (32.5, 33.5)  # the force sensor tells the same again and again
PERSON = (30.0, 38.0)  # comes near, stands beside the arm, and goes
HANGING = (50.0, 51.0)  # the driver of the scanner
TIPPING = Tipping(55.0)  # pushed over the edge of a dock

LIDAR = Lidar(
    angles=np.linspace(-math.pi, math.pi, 720, endpoint=False, dtype=np.float64),
    least=0.1,
    most=30.0,
    steps=32,
)
PERIOD = 0.08
SCANNER = Scanner(
    LIDAR,
    PERIOD,
    blind=(40.0, 42.0),
    covered=(43.5, 45.5),
    dusty=(47.0, 49.0),
    narrow=(52.0, 52.8),
    narrowed=(-1.48, 1.48),
    cloth=0.125,
)
BASE = Base(
    legs=(
        Leg(1.0),
        Leg(4.0, 0.4),
        Leg(6.0),
        Leg(13.0, 0.4),
        Leg(16.0, 0.65, 0.0),
        Leg(18.0, 0.3, 0.3),
        Leg(SECONDS),
    ),
    start=(-4.0, 0.0, 0.0),
    acceleration=0.8,
)
OBSTACLES: Sequence[Obstacle] = [*room(-7.0, -4.0, 8.0, 4.0), Pillar(-1.0, 2.5, 0.3)]
JOINTS = ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3")
HOME = (0.0, -1.6, 1.8, -1.8, -1.57, 0.0)
ABOVE = (0.6, -1.2, 1.6, -2.0, -1.57, 0.0)
FOLDED = (0.6, -1.0, 2.7, -2.2, -1.57, 0.0)
PLACED = (0.6, -1.0, 1.7, -2.2, -1.57, 0.0)
ARM = Motion(
    (
        (18.5, HOME),
        (20.5, ABOVE),
        (22.0, PLACED),
        (24.0, PLACED),
        (25.0, ABOVE),
        (27.0, PLACED),
        (31.0, PLACED),
        (31.4, FOLDED),  # too fast, and too far
        (32.0, FOLDED),
        (33.5, ABOVE),
        (34.0, ABOVE),
        (37.0, HOME),
    )
)
FRAMES = (Frame("scanner", "base_link", (0.0, 0.0, 0.2)),)
STORE = store_of(robot("heron"))


def scan(t: float) -> dict[str, Any]:
    """Somebody crosses the way of the base; later somebody comes to its arm."""
    obstacles = list(OBSTACLES)
    if during(t, CROSSING):
        obstacles.append(Pillar(-2.2, curve(t, (CROSSING[0], -2.0), (CROSSING[1], 2.5)), 0.2))
    if during(t, PERSON):
        away = curve(t, (30.0, 3.8), (33.0, 1.0), (35.0, 1.0), (38.0, 3.8))
        now = BASE.at(t)
        obstacles.append(
            Pillar(now.x + away * math.cos(now.yaw), now.y + away * math.sin(now.yaw), 0.2)
        )
    return SCANNER.fields(t, BASE.at(t).place, obstacles)


def tilt(t: float) -> tuple[float, float]:
    """Its roll and its pitch (rad)."""
    bump = curve(t, (7.0, 0.0), (7.1, -4.0), (7.25, 4.0), (7.4, 0.0))
    slope = curve(t, (9.0, 0.0), (9.4, -17.0), (11.4, -17.0), (12.0, 0.0))
    return 0.0, math.radians(bump + slope)


def jolt(t: float) -> float:
    """The acceleration that the bump gives its axles (m/s^2)."""
    return 8.0 * math.sin(2 * math.pi * 10.0 * t) if during(t, BUMP) else 0.0


def wrench(t: float) -> dict[str, Any]:
    """The block hammers on the table; the hand touches it harder than it should."""
    hammering = 12.0 * math.sin(2 * math.pi * 6.0 * t) if during(t, HAMMERING) else 0.0
    touching = 40.0 if during(t, TOUCHING) else 80.0 if during(t, CLAMPING) else 0.0
    noise = 0.0 if during(t, NUMB) else (round(t * 125) % 2) / 64
    return {
        "wrench__force__z": rounded(-4.0 + hammering - touching + noise),
        "wrench__torque__z": 7.0 if during(t, TWISTING) else 0.0,
    }


def joints(t: float) -> dict[str, Any]:
    """Its arm; for a while it carries more than it should, and hits something with its elbow."""
    load = curve(t, (28.0, 20.0), (28.2, 95.0), (30.8, 95.0), (31.0, 20.0))
    shoulder = 145.0 if during(t, (29.0, 29.1)) else load
    elbow = 40.0 if during(t, (29.5, 30.0)) else 12.0
    wrist = 20.0 if during(t, OVERLOAD) else 3.0
    return joint_state(JOINTS, ARM, t, (0.0, shoulder, elbow, wrist, 1.0, 0.0))


def sensors() -> Sequence[Sensor]:
    """All topics."""
    return [
        *driving(STORE, BASE, FRAMES, 50),
        Sensor(
            "/scan",
            "sensor_msgs/LaserScan",
            every(1 / PERIOD, SECONDS),
            scan,
            "scanner",
            [SILENT],
            [HANGING],
        ),
        Sensor(
            "/imu/data",
            "sensor_msgs/Imu",
            every(100, SECONDS),
            lambda t: TIPPING.imu(t, BASE.at(t), *tilt(t), jolt(t)),
            "imu",
        ),
        Sensor("/wrench", "geometry_msgs/WrenchStamped", every(125, SECONDS), wrench, "wrist"),
        Sensor("/joint_states", "sensor_msgs/JointState", every(125, SECONDS), joints, ""),
    ]
