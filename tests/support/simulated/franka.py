"""A Franka Research 3 with its gripper: all that its rules are there for happens to it, in 36 s."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from rossmarie.driver.robots import robot
from support.simulated.base import curve
from support.simulated.motion import Floats, Motion, about_x, about_z, joint_state, moved, pose
from support.simulated.recording import Sensor, during, every, rounded, store_of

SECONDS = 36.0
TWISTING = (5.2, 5.6)  # the tool has caught in something
CHATTER = (11.0, 12.0)  # a peg on the rim of its hole
SLIPPED = (14.5, 16.0)  # the gripper closes on nothing
USER_STOP = (17.0, 19.0)
REFLEX = (20.0, 21.5)
GUIDING = (22.5, 24.5)
SILENT = (25.5, 26.1)
LATE = (27.5, 29.0)  # commands that come too late
NUMB = (29.5, 30.5)  # the same force is reported again and again
HEAVY = (13.2, 16.2)  # what it carries

JOINTS = tuple(f"fr3_joint{number}" for number in range(1, 8))
FINGERS = ("fr3_finger_joint1", "fr3_finger_joint2")
LOW = (0.4, 0.6, 0.1, -2.2, 0.0, 2.6, 0.9)  # in the table
READY = (0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785)
REACHING = (0.4, -0.3, 0.1, -1.9, 0.0, 1.7, 0.9)
SWUNG = (-1.4, -0.5, 0.0, -2.1, 0.0, 1.6, 0.8)
STRETCHED = (0.4, 0.6, 0.1, -0.22, 0.0, 1.2, 0.9)
MOTION = Motion(
    (
        (1.0, READY),
        (3.0, REACHING),
        (6.0, REACHING),
        (7.5, SWUNG),  # too fast for its first joint
        (8.5, REACHING),
        (8.9, REACHING),
        (9.5, STRETCHED),
        (10.0, STRETCHED),
        (11.0, REACHING),
        (13.0, READY),
        (22.5, READY),
        (24.5, REACHING),
        (30.0, READY),
        (32.0, LOW),
        (32.6, LOW),
        (34.0, READY),
    )
)
STORE = store_of(robot("franka"))

# The lengths and turns of its links (m, rad), by the convention of Craig: about x, then along
# x and z, a turn about z.
LINKS = (
    (0.0, 0.0, 0.333),
    (-math.pi / 2, 0.0, 0.0),
    (math.pi / 2, 0.0, 0.316),
    (math.pi / 2, 0.0825, 0.0),
    (-math.pi / 2, -0.0825, 0.384),
    (math.pi / 2, 0.0, 0.0),
    (math.pi / 2, 0.088, 0.0),
)
FLANGE_TO_HAND = 0.107 + 0.1034


CONTACT = ((3.98, 0.0), (4.04, 32.0), (4.8, 32.0), (4.84, 70.0), (4.96, 70.0), (5.0, 0.0))
"""The force (N) by which the hand is pressed, at instants (s)."""


def hand(t: float) -> Floats:
    """The pose of the hand, as a matrix."""
    found = np.eye(4)
    for angle, (twist, length, offset) in zip(MOTION.positions(t), LINKS, strict=True):
        found = found @ about_x(twist) @ moved(length, offset) @ about_z(angle)
    return found @ moved(0.0, FLANGE_TO_HAND)


def force(t: float) -> float:
    """The force that pushes the hand downwards (N)."""
    chatter = 11.0 * math.sin(2 * math.pi * 5.0 * t) if during(t, CHATTER) else 0.0
    contact = curve(t, *CONTACT)
    noise = 0.0 if during(t, NUMB) else (round(t * 50) % 2) / 64
    return 2.0 + contact + chatter + noise


def mode(t: float) -> int:
    """The mode of the robot: it moves, unless something stops it, or somebody leads it."""
    if during(t, USER_STOP):
        return 5
    return 4 if during(t, REFLEX) else 3 if during(t, GUIDING) else 2


def joints(t: float, path: str = "") -> dict[str, Any]:
    """The joints; for a while the arm carries more than it should, and its elbow hits something."""
    is_heavy = during(t, HEAVY)
    shoulder = -86.0 if during(t, (15.5, 15.6)) else -60.0 if is_heavy else -12.0
    elbow = 45.0 if during(t, (14.5, 15.0)) else 18.0
    weights = (0.1, shoulder, 0.2, elbow, 9.0 if is_heavy else 0.6, 2.1, 0.1)
    return joint_state(JOINTS, MOTION, t, weights, path)


def wrench(t: float) -> dict[str, Any]:
    """The force and the torque at its hand."""
    return {
        "wrench__force__z": rounded(-force(t), 6),
        "wrench__torque__z": 7.0 if during(t, TWISTING) else 0.25,
    }


def state(t: float) -> dict[str, Any]:
    """The state of the robot; most of its fields stay zero."""
    pushed = force(t)
    torques = (0.2, 0.55 * pushed, 0.1, 0.5 * pushed, 0.05, 0.1, 0.0)
    reflex = during(t, REFLEX)
    return {
        **joints(t, "measured_joint_state__"),
        "tau_ext_hat_filtered__name": list(JOINTS),
        "tau_ext_hat_filtered__effort": [rounded(each, 6) for each in torques],
        **pose(hand(t), "o_t_ee__"),
        "o_t_ee__header__frame_id": "fr3_link0",
        "o_f_ext_hat_k__header__frame_id": "fr3_link0",
        "o_f_ext_hat_k__wrench__force__z": rounded(-pushed, 6),
        "collision_indicators__is_cartesian_linear_contact__z": float(pushed > 20.0),
        "time": t,
        "control_command_success_rate": 0.78 if during(t, LATE) else 0.99,
        "robot_mode": mode(t),
        "current_errors__cartesian_reflex": reflex,
    }


def gripper(t: float) -> dict[str, Any]:
    """The gripper holds a peg, which slips away; later it opens."""
    half = curve(t, (12.0, 0.04), (13.0, 0.012), SLIPPED_FROM, (14.7, 0.0), (15.8, 0.0), OPENED)
    return {
        "name": list(FINGERS),
        "position": [rounded(half, 14)] * 2,
        "velocity": [0.0, 0.0],
        "effort": [0.0, 0.0],
    }


SLIPPED_FROM = (SLIPPED[0], 0.012)
OPENED = (SLIPPED[1], 0.03)


def sensors() -> Sequence[Sensor]:
    """All topics."""
    reported = (
        ("measured_joint_states", "sensor_msgs/JointState", joints),
        ("current_pose", "geometry_msgs/PoseStamped", lambda t: pose(hand(t))),
        ("external_wrench_in_base_frame", "geometry_msgs/WrenchStamped", wrench),
    )
    return [
        Sensor(
            "/franka_robot_state_broadcaster/robot_state",
            "franka_msgs/FrankaRobotState",
            every(50, SECONDS),
            state,
            "fr3_link0",
            [SILENT],
        ),
        *(
            Sensor(
                f"/franka_robot_state_broadcaster/{topic}",
                kind,
                every(50, SECONDS),
                read,
                "fr3_link0",
                [SILENT],
            )
            for topic, kind, read in reported
        ),
        Sensor(
            "/franka_gripper/joint_states",
            "sensor_msgs/JointState",
            every(50, SECONDS),
            gripper,
            "",
        ),
    ]
