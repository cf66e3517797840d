"""A Husky on rough ground: all that its rules are there for happens to it once, in 48 s."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from rossmarie.driver.robots import robot
from support.simulated.base import Base, Leg, Now, command, curve, odometry
from support.simulated.frames import Frame
from support.simulated.mobile import driving
from support.simulated.recording import Sensor, during, every, rounded, store_of
from support.simulated.troubles import Tipping
from support.simulated.world import Lidar, Obstacle, Pillar, Wall

SECONDS = 48.0
PERSON = (5.0, 10.0)  # somebody walks towards it, and goes aside
DOWNHILL = (12.0, 15.0)  # it rolls faster than it may
ROUGH = (16.0, 17.0)
LEANING = (18.0, 20.5)
STUCK = (22.0, 24.5)  # its wheels are blocked
HOT = (23.0, 28.0)
EMERGENCY = (29.0, 31.0)  # somebody presses the button
DAZZLED = (32.0, 32.8)  # the lidar says nothing
MUD = (34.0, 36.0)  # the wheels turn, and the base stands
ICE = (36.2, 37.4)  # it turns otherwise than its wheels
PUSHED = (39.0, 41.0)  # and rolls on
TIPPING = Tipping(44.0)  # over the edge of a dock
LATE = [(10.2 + 0.4 * count, 10.35 + 0.4 * count) for count in range(5)]
SILENT = (31.2, 31.7)  # the odometry of the wheels

# Out of doors most beams of the LMS111 come back from nowhere: its driver tells that as 0. It hangs
# upside down: its angles grow clockwise.
LIDAR = Lidar(
    angles=np.linspace(-2.35619449, 2.35619449, 541),
    least=0.01,
    most=20.0,
    x=0.337,
    is_upside_down=True,
    nothing=0.0,
    steps=32,
)
PERIOD = 0.04
BASE = Base(
    legs=(
        Leg(1.0),
        Leg(8.0, 0.6),
        Leg(10.0),
        Leg(12.0, 0.8),
        Leg(15.0, 1.15),
        Leg(20.5, 0.8, 0.05),
        Leg(24.5, 0.5),
        Leg(26.0),
        Leg(29.0, 0.5, -0.1),
        Leg(31.0),
        Leg(38.0, 0.4),
        Leg(41.6),
        Leg(43.5, 0.4),
        Leg(SECONDS),
    ),
    start=(0.0, 0.0, 0.0),
    acceleration=3.0,
    held=(STUCK, EMERGENCY),
)
OBSTACLES: Sequence[Obstacle] = [
    Wall(-10.0, 3.0, 40.0, 3.5),
    Pillar(6.0, -3.0, 0.3),
    Pillar(14.0, -4.0, 0.25),
    Pillar(21.0, -2.5, 0.3),
]
FRAMES = (
    Frame("front_laser", "base_link", (LIDAR.x, 0.0, 0.30795), (math.pi, 0.0, 0.0)),
    Frame("imu_link", "base_link", (0.19, 0.0, 0.149)),
)
STORE = store_of(robot("husky"))


def scan(t: float) -> dict[str, Any]:
    """Somebody comes from the front, stops close to the robot, and goes aside."""
    x = curve(t, (PERSON[0], 9.5), (7.5, 5.9))
    y = curve(t, (8.8, 0.0), (PERSON[1], -2.0))
    obstacles = [*OBSTACLES, Pillar(x, y, 0.2)] if during(t, PERSON) else OBSTACLES
    return LIDAR.fields(LIDAR.scan(BASE.at(t).place, obstacles), PERIOD)


def tilt(t: float) -> tuple[float, float]:
    """Its roll and its pitch (rad): downhill, and along a slope."""
    pitch = curve(t, (11.5, 0.0), (12.2, 9.0), (14.6, 9.0), (15.2, 0.0))
    roll = curve(t, (18.0, 0.0), (18.6, 22.0), (20.0, 22.0), (20.5, 0.0))
    return math.radians(roll), math.radians(pitch)


def inertia(t: float) -> dict[str, Any]:
    """The accelerations of its IMU: stones under its wheels, and at last a fall."""
    jolt = 6.0 * math.sin(2 * math.pi * 7.0 * t) if during(t, ROUGH) else 0.0
    return TIPPING.imu(t, BASE.at(t), *tilt(t), jolt)


def body(t: float) -> Now:
    """The motion of the base, apart from its wheels."""
    now = BASE.at(t)
    if during(t, MUD):
        return replace(now, speed=0.0)
    if during(t, ICE):
        return replace(now, turn=now.turn + 0.8)
    return replace(now, speed=0.3) if during(t, PUSHED) else now


def status(t: float) -> dict[str, Any]:
    """Its drivers, its battery, and its button."""
    is_stuck = during(t, STUCK)
    current = 38.0 if is_stuck else 4.0 + 6.0 * abs(BASE.at(t).speed)
    heat = curve(t, (22.0, 48.0), (HOT[0] + 1.5, 86.0), (HOT[1] - 1.0, 80.0), (34.0, 60.0))
    voltage = rounded(26.0 - 0.08 * current)
    return {
        "uptime": round(t * 1000) + 60_000,
        "ros_control_loop_freq": 50.0,
        "mcu_and_user_port_current": 1.0,
        "left_driver_current": rounded(current),
        "right_driver_current": rounded(current),
        "battery_voltage": voltage,
        "left_driver_voltage": voltage,
        "right_driver_voltage": voltage,
        "left_driver_temp": rounded(0.6 * heat),
        "right_driver_temp": rounded(0.6 * heat),
        "left_motor_temp": rounded(heat),
        "right_motor_temp": rounded(heat - 2.0),
        "capacity_estimate": 480,
        "charge_estimate": rounded(0.12 if is_stuck else 0.24),
        "e_stop": during(t, EMERGENCY),
        "current_limit": is_stuck,
    }


def sensors() -> Sequence[Sensor]:
    """All topics."""
    controller = "/husky_velocity_controller"
    return [
        *driving(
            STORE, BASE, FRAMES, 50, f"{controller}/odom", f"{controller}/cmd_vel", [*LATE, SILENT]
        ),
        Sensor(
            f"{controller}/unfil_cmd_vel",
            "geometry_msgs/Twist",
            every(20, SECONDS),
            lambda t: command(BASE.wanted(t)),
        ),
        Sensor(
            "/odometry/filtered",
            "nav_msgs/Odometry",
            every(50, SECONDS),
            lambda t: odometry(body(t)),
            "odom",
        ),
        Sensor(
            "/front/scan",
            "sensor_msgs/LaserScan",
            every(1 / PERIOD, SECONDS),
            scan,
            "front_laser",
            [DAZZLED],
        ),
        Sensor(
            "/imu/data",
            "sensor_msgs/Imu",
            every(50, SECONDS),
            inertia,
            "imu_link",
        ),
        Sensor("/status", "husky_msgs/HuskyStatus", every(1, SECONDS), status, ""),
    ]
