"""A UR5e at a bench: all that its rules are there for happens to it once, in 42 s."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from rossmarie.driver.robots import robot
from support.simulated.base import curve
from support.simulated.motion import Floats, Motion, about_x, about_z, joint_state, moved, pose
from support.simulated.recording import Sensor, during, every, rounded, store_of

SECONDS = 42.0
CHATTER = (8.0, 9.0)  # the tool on the workpiece
PUSH = (10.0, 10.6)  # against something hard
TWIST = (12.0, 12.6)
RESTART = (16.0, 16.6)  # of the driver, which tells joints in another order afterwards
PROTECTIVE_STOP = (19.0, 21.0)
REDUCED = (23.0, 25.0)
HOT = (26.0, 30.0)  # the tool
NUMB = (38.0, 39.0)  # the force sensor tells the same again and again
STUTTER = [(8.0 + 0.4 * count, 8.17 + 0.4 * count) for count in range(5)]
"""Stretches in which no joints are reported: the network is busy."""

JOINTS = (
    "shoulder_pan_joint",
    "shoulder_lift_joint",
    "elbow_joint",
    "wrist_1_joint",
    "wrist_2_joint",
    "wrist_3_joint",
)
ELBOW_FIRST = (2, 1, 0, 3, 4, 5)
"""The order in which some drivers tell joints."""
HOME = (0.0, -1.57, 1.57, -1.57, -1.57, 0.0)
BENCH = (0.5, -1.2, 1.9, -2.2, -1.57, 0.0)
FAR = (0.5, -0.35, 0.3, -1.5, -1.57, 0.0)
LOW = (0.5, -0.8, 1.9, -2.2, -1.57, 0.0)  # below its bench
FOLDED = (0.5, -1.2, 2.75, -2.2, -1.57, 0.0)
TURNED = (2.0, -1.57, 1.57, -1.57, -1.57, 0.0)
MOTION = Motion(
    (
        (1.0, HOME),
        (3.0, BENCH),
        (4.0, BENCH),
        (5.2, TURNED),  # too fast for its shoulder
        (7.0, BENCH),
        (13.0, BENCH),
        (13.45, FOLDED),  # and stops with a jerk
        (14.8, FOLDED),
        (16.0, BENCH),
        (18.0, BENCH),
        (19.0, FAR),
        (22.0, FAR),
        (24.0, HOME),
        (28.0, HOME),
        (31.0, BENCH),
        (33.0, LOW),
        (33.6, LOW),
        (35.0, BENCH),
    )
)
STORE = store_of(robot("ur5e"))

# The lengths and turns of its links (m, rad), by the convention of Denavit and Hartenberg.
LINKS = (
    (0.1625, 0.0, math.pi / 2),
    (0.0, -0.425, 0.0),
    (0.0, -0.3922, 0.0),
    (0.1333, 0.0, math.pi / 2),
    (0.0997, 0.0, -math.pi / 2),
    (0.0996, 0.0, 0.0),
)


def hand(t: float) -> Floats:
    """The pose of the hand, as a matrix."""
    found = np.eye(4)
    for angle, (offset, length, twist) in zip(MOTION.positions(t), LINKS, strict=True):
        found = found @ about_z(angle) @ moved(length, offset) @ about_x(twist)
    return found


def joints(t: float) -> dict[str, Any]:
    """The joints; their efforts are currents."""
    order = ELBOW_FIRST if t < RESTART[0] else range(len(JOINTS))
    currents = (0.3, 2.1, 1.4, 0.4, 0.3, 0.1)
    return joint_state(JOINTS, MOTION, t, currents, order=order)


def wrench(t: float) -> dict[str, Any]:
    """The tool chatters on a workpiece, hits something hard, and is twisted."""
    chatter = 14.0 * math.sin(2 * math.pi * 8.0 * t) if during(t, CHATTER) else 0.0
    push = curve(t, (9.98, 0.0), (10.05, 62.0), (10.5, 62.0), (10.6, 0.0))
    twist = curve(t, (11.98, 0.0), (12.1, 9.0), (12.5, 9.0), (12.6, 0.0))
    return {
        "wrench__force__x": 1.5 if during(t, NUMB) else 1.5 + (round(t * 125) % 2) / 64,
        "wrench__force__z": rounded(-3.0 - chatter - push),
        "wrench__torque__z": rounded(0.2 + twist),
    }


def speed_scaling(t: float) -> dict[str, Any]:
    """The part of its speed that a robot may use, in percent."""
    return {"data": 0.0 if during(t, PROTECTIVE_STOP) else 30.0 if during(t, REDUCED) else 100.0}


def safety_mode(t: float) -> dict[str, Any]:
    """The mode of its safety controller: normal, reduced, or a protective stop."""
    return {"mode": 3 if during(t, PROTECTIVE_STOP) else 2 if during(t, REDUCED) else 1}


def robot_mode(_t: float) -> dict[str, Any]:
    """The mode of the robot: it runs."""
    return {"mode": 7}


def tool(t: float) -> dict[str, Any]:
    """The tool gets hot."""
    heat = curve(t, (0.0, 34.0), (HOT[0], 48.0), (27.5, 64.0), (28.5, 64.0), (HOT[1], 52.0))
    return {"tool_voltage_48v": 48.0, "tool_current": 0.25, "tool_temperature": rounded(heat, 4)}


def sensors() -> Sequence[Sensor]:
    """All topics. Modes are reported when they change."""
    changes = [0.0, *PROTECTIVE_STOP, *REDUCED]
    status = "/io_and_status_controller"
    return [
        Sensor(f"{status}/safety_mode", "ur_dashboard_msgs/SafetyMode", changes, safety_mode),
        Sensor(f"{status}/robot_mode", "ur_dashboard_msgs/RobotMode", [0.0], robot_mode),
        Sensor(
            "/joint_states",
            "sensor_msgs/JointState",
            every(125, SECONDS),
            joints,
            "base_link",
            [RESTART, *STUTTER],
        ),
        Sensor(
            "/force_torque_sensor_broadcaster/wrench",
            "geometry_msgs/WrenchStamped",
            every(125, SECONDS),
            wrench,
            "tool0_controller",
            [RESTART],
        ),
        Sensor(
            "/tcp_pose_broadcaster/pose",
            "geometry_msgs/PoseStamped",
            every(125, SECONDS),
            lambda t: pose(hand(t)),
            "base",
            [RESTART],
        ),
        Sensor(
            "/speed_scaling_state_broadcaster/speed_scaling",
            "std_msgs/Float64",
            every(100, SECONDS),
            speed_scaling,
            silent=[RESTART],
        ),
        Sensor(f"{status}/tool_data", "ur_msgs/ToolDataMsg", every(10, SECONDS), tool),
    ]
