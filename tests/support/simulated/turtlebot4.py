"""A TurtleBot 4 in a room: all that its rules are there for happens to it once, in 64 s."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from rossmarie.driver.robots import robot
from support.made_messages import made
from support.simulated.base import GRAVITY, Base, Leg, curve, imu
from support.simulated.frames import Frame
from support.simulated.mobile import driving
from support.simulated.recording import Sensor, during, every, header, rounded, store_of
from support.simulated.troubles import Scanner
from support.simulated.world import Lidar, Obstacle, Pillar, Wall, room

SECONDS = 64.0
PERSON = (5.0, 9.0)  # somebody steps in front of it, and goes on
SPEEDING = (10.5, 12.5)  # as with the safety override: the robot reaches 0.46 m/s
BUMP = (14.0, 14.6)  # against something that the lidar does not see
BACKED_UP = (15.6, 16.2)
SILL = (18.0, 20.0)  # it climbs
STALL = (21.0, 23.0)
LIFTED = (25.0, 27.0)  # so that its lidar sees nothing near
TUMBLING = (26.55, 26.65)  # it slips out of the hands
DROPPED = (27.1, 27.3)
UNPLUGGED = (29.0, 30.2)  # the lidar
HANGING = (32.0, 33.0)  # its driver
DOCKED = 36.0
HOT = (9.0, 13.0)  # the battery
STRAINED = (20.5, 25.0)
EMPTY = (27.5, 36.5)
COLD = (37.0, 49.5)  # while it is charged
ILL = (50.5, 52.5)

# Beams as in turtlebot/turtlebot4#664: less than a whole turn, 7.7 times a second. The lidar is
# mounted with a quarter turn: ahead of the robot is at -90 degrees of the scan.
PERIOD = 0.13
LIDAR = Lidar(
    angles=np.linspace(-3.1241393, 3.1415927, 269),
    least=0.15,
    most=12.0,
    x=-0.04,
    yaw=math.pi / 2,
)
SCANNER = Scanner(
    LIDAR,
    PERIOD,
    blind=LIFTED,
    covered=(38.0, 40.0),
    dusty=(42.0, 44.0),
    narrow=(35.0, 35.8),
    narrowed=(-3.05, -0.09),
    cloth=0.1640625,
)
BASE = Base(
    legs=(
        Leg(1.0),
        Leg(5.6, 0.25),
        Leg(9.5),
        Leg(10.5, 0.25),
        Leg(12.5, 0.45),
        Leg(14.0, 0.25),
        Leg(14.6),
        Leg(16.2, -0.1),
        Leg(17.0),
        Leg(17.8, 0.0, -1.9),
        Leg(20.6, 0.2),
        Leg(23.0, 0.2),
        Leg(24.0),
        Leg(28.0),
        Leg(28.8, 0.0, -1.9),
        Leg(33.0, 0.25),
        Leg(34.0),
        Leg(DOCKED, 0.1),
        Leg(SECONDS),
    ),
    start=(0.0, 0.0, 0.0),
    acceleration=0.9,
    held=(BUMP, STALL, (24.0, 28.0)),
)
# The room has a door through which the lidar sees nothing.
OBSTACLES: Sequence[Obstacle] = [
    *room(-1.2, -2.6, 4.4, 2.4)[:3],
    Wall(-1.2, 2.4, -1.2, 0.6),
    Wall(-1.2, -0.4, -1.2, -2.6),
    Pillar(0.8, 1.5, 0.3),
    *room(2.2, -2.0, 2.8, -1.6),
]
STORE = store_of(robot("turtlebot4"))


def scan(t: float) -> dict[str, Any]:
    """Somebody comes from the left, stands 0.3 m in front of the robot, and goes on."""
    person = Pillar(
        1.65, curve(t, (PERSON[0], 1.4), (6.2, 0.0), (7.8, 0.0), (PERSON[1], -1.4)), 0.2
    )
    obstacles = [*OBSTACLES, person] if during(t, PERSON) else OBSTACLES
    return SCANNER.fields(t, BASE.at(t).place, obstacles)


def tilt(t: float) -> tuple[float, float]:
    """Its roll and its pitch: a sill at both of its ends, and hands that lift it."""
    pitch = curve(
        t, (18.0, 0.0), (18.3, -14.0), (19.0, -14.0), (19.4, 0.0), (19.8, 9.0), (20.1, 0.0)
    )
    roll = curve(
        t, (25.0, 0.0), (25.4, 24.0), (26.5, 24.0), (26.7, 52.0), (26.8, 52.0), (27.0, 0.0)
    )
    return math.radians(roll), math.radians(pitch)


def inertia(t: float) -> dict[str, Any]:
    """The accelerations of its IMU: none in a fall, and a jolt at the foot of the sill."""
    jolt = -GRAVITY if during(t, DROPPED) else 5.0 if during(t, (20.1, 20.15)) else 0.0
    tumbling = math.radians(140.0) if during(t, TUMBLING) else 0.0
    return imu(BASE.at(t), *tilt(t), jolt, tumbling)


HAZARDS = {
    "bump_front_center": (1, BUMP),
    "base_link": (0, BACKED_UP),
    "left_wheel": (3, STALL),
    "right_wheel": (3, STALL),
    "wheel_drop_left": (4, LIFTED),
    "wheel_drop_right": (4, LIFTED),
    "cliff_front_left": (2, (25.2, LIFTED[1])),
}
"""The detected hazards with their places, types and times."""


def hazards(t: float) -> dict[str, Any]:
    """All that are there."""
    at_ns = round(t * 1e9)
    found = [
        made(STORE, "irobot_create_msgs/HazardDetection", type=kind, **header(at_ns, frame))
        for frame, (kind, stretch) in HAZARDS.items()
        if during(t, stretch)
    ]
    return {"detections": found}


def battery(t: float) -> dict[str, Any]:
    """A battery that gets hot, strains, is empty, is charged in the cold, and gets ill; hours pass
    in seconds.
    """
    is_strained = during(t, STRAINED)
    percentage = 0.04 if during(t, EMPTY) else 0.4
    return {
        "voltage": 12.5 if is_strained else rounded(13.5 + 3.0 * percentage),
        "temperature": 58.0 if during(t, HOT) else -3.0 if during(t, COLD) else 28.0,
        "current": -4.5 if is_strained else 1.5 if t > DOCKED else -0.8,
        "percentage": rounded(percentage),
        "power_supply_health": 2 if during(t, ILL) else 1,
        "present": True,
    }


def wheels(t: float) -> dict[str, Any]:
    """The motors strain where the wheels do not turn."""
    current = 900 if during(t, STALL) else round(400 * abs(BASE.at(t).speed))
    return {
        "current_ma_left": current,
        "current_ma_right": current,
        "pwm_left": round(30000 * BASE.wanted(t).speed),
        "pwm_right": round(30000 * BASE.wanted(t).speed),
        "wheels_enabled": True,
    }


FRAMES = (
    Frame("shell_link", "base_link", (0.0, 0.0, 0.0942)),
    Frame("rplidar_link", "shell_link", (-0.04, 0.0, 0.098715), (0.0, 0.0, math.pi / 2)),
)


def sensors() -> Sequence[Sensor]:
    """All topics."""
    names = "irobot_create_msgs"
    return [
        *driving(STORE, BASE, FRAMES, 20),
        Sensor(
            "/scan",
            "sensor_msgs/LaserScan",
            every(1 / PERIOD, SECONDS),
            scan,
            "rplidar_link",
            [UNPLUGGED],
            [HANGING],
        ),
        Sensor(
            "/imu",
            "sensor_msgs/Imu",
            every(62.5, SECONDS),
            inertia,
            "imu_link",
        ),
        Sensor(
            "/hazard_detection",
            f"{names}/HazardDetectionVector",
            every(10, SECONDS),
            hazards,
            "base_link",
        ),
        Sensor(
            "/kidnap_status",
            f"{names}/KidnapStatus",
            every(1, SECONDS),
            lambda t: {"is_kidnapped": during(t, (LIFTED[0] + 0.3, LIFTED[1] + 0.6))},
            "base_link",
        ),
        Sensor(
            "/dock_status",
            f"{names}/DockStatus",
            every(1, SECONDS),
            lambda t: {"dock_visible": t > DOCKED - 4, "is_docked": t > DOCKED},
            "base_link",
        ),
        Sensor(
            "/slip_status",
            f"{names}/SlipStatus",
            every(20, SECONDS),
            lambda t: {"is_slipping": during(t, STALL)},
            "base_link",
        ),
        Sensor("/wheel_status", f"{names}/WheelStatus", every(20, SECONDS), wheels, "base_link"),
        Sensor("/battery_state", "sensor_msgs/BatteryState", every(1, SECONDS), battery, "base"),
    ]
