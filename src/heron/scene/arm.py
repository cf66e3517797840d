"""The arm: with the lengths, masses and torques of a UR5e, and capsules as links.

It stands on a pedestal and holds a block. Its joints are position servos with gravity compensation,
like the inner loop of such an arm. Outer control loops are in other modules.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import mujoco

from heron.scene.ground import Contact

_GEOM = mujoco.mjtGeom
_HALF_TURN = math.sqrt(0.5)
_ABOUT_Y = (_HALF_TURN, 0.0, _HALF_TURN, 0.0)
_UPRIGHT = (1.0, 0.0, 0.0, 0.0)
GRIP = "grip"
"""The equality that is active while the hand holds the block."""
HOME = (-math.pi / 2, -math.pi / 2, math.pi / 2, -math.pi / 2, -math.pi / 2, 0.0)


@dataclass(frozen=True)
class Link:
    """A link: where its joint is on the link before, its axis, and the capsule that it is."""

    name: str
    place: tuple[float, float, float]
    turned: tuple[float, float, float, float]
    axis: tuple[float, float, float]
    end: tuple[float, float, float]
    radius: float
    mass: float
    torque: float
    stiffness: float


LINKS = (
    Link("shoulder", (0, 0, 0.163), _UPRIGHT, (0, 0, 1), (0, 0.1, 0), 0.06, 3.76, 150, 8000),
    Link("upper_arm", (0, 0.138, 0), _ABOUT_Y, (0, 1, 0), (0, 0, 0.425), 0.05, 8.06, 150, 8000),
    Link("forearm", (0, -0.131, 0.425), _UPRIGHT, (0, 1, 0), (0, 0, 0.392), 0.04, 2.85, 150, 8000),
    Link("wrist_1", (0, 0, 0.392), _ABOUT_Y, (0, 1, 0), (0, 0.1, 0), 0.04, 1.37, 28, 1500),
    Link("wrist_2", (0, 0.127, 0), _UPRIGHT, (0, 0, 1), (0, 0, 0.08), 0.04, 1.3, 28, 1500),
    Link("wrist_3", (0, 0, 0.1), _UPRIGHT, (0, 1, 0), (0, 0.06, 0), 0.035, 0.37, 28, 1500),
)
JOINTS = tuple(link.name for link in LINKS)


@dataclass(frozen=True)
class ArmParameters:
    """Lengths in m, masses in kg, stiffnesses of joints in Nm/rad (they stand with the links).

    Rotors and gears weigh on the joints as `armature` (kg m^2) says; without it, the wrist is so
    light that no servo holds it.
    """

    armature: tuple[float, float, float, float, float, float] = (1, 1, 1, 0.2, 0.2, 0.2)
    damping: float = 5.0
    pedestal: float = 0.6
    hand_length: float = 0.1
    hand_mass: float = 0.9
    block_half: float = 0.025
    block_mass: float = 0.5
    contact_time: float = 0.01
    """The softness of the block on a table (s)."""
    grip_time: float = 0.004
    """The softness of the fingers (s)."""


def add_arm(spec: Any, arm: ArmParameters) -> None:
    """The arm, its hand with a block in it, its servos and its force-torque sensor."""
    body = spec.worldbody.add_body(name="pedestal", pos=[0, 0, arm.pedestal])
    half = arm.pedestal / 2
    body.add_geom(type=_GEOM.mjGEOM_BOX, size=[0.1, 0.1, half], pos=[0, 0, -half])
    body.add_geom(  # what the shoulder turns on; to be looked at only
        type=_GEOM.mjGEOM_CYLINDER,
        fromto=[0, 0, 0, *LINKS[0].place],
        size=[LINKS[0].radius, 0, 0],
        contype=0,
        conaffinity=0,
    )
    for link, armature in zip(LINKS, arm.armature, strict=True):
        body = _add_link(spec, body, link, armature, arm.damping)
    _add_hand(spec, body, arm)


def _add_link(spec: Any, parent: Any, link: Link, armature: float, damping: float) -> Any:
    body = parent.add_body(name=link.name, pos=link.place, quat=link.turned, gravcomp=1)
    body.add_joint(
        name=link.name,
        type=mujoco.mjtJoint.mjJNT_HINGE,
        axis=link.axis,
        armature=armature,
        damping=[damping, 0, 0],
    )
    body.add_geom(
        type=_GEOM.mjGEOM_CAPSULE,
        fromto=[0, 0, 0, *link.end],
        size=[link.radius, 0, 0],
        mass=link.mass,
        contype=0,
        conaffinity=0,
    )
    servo = spec.add_actuator(
        name=link.name, target=link.name, trntype=mujoco.mjtTrn.mjTRN_JOINT, forcelimited=True
    )
    servo.set_to_position(kp=link.stiffness, dampratio=1)
    servo.forcerange = [-link.torque, link.torque]
    return body


def _add_hand(spec: Any, wrist: Any, arm: ArmParameters) -> None:
    """Along the y axis of the wrist; where it is mounted, forces are measured."""
    hand = wrist.add_body(name="hand", pos=[0, 0.1, 0], gravcomp=1)
    hand.add_site(name="flange")
    hand.add_geom(
        type=_GEOM.mjGEOM_CAPSULE,
        fromto=[0, 0, 0, 0, arm.hand_length - 0.04, 0],
        size=[0.03, 0, 0],
        mass=arm.hand_mass,
        contype=0,
        conaffinity=0,
    )
    reach = arm.hand_length + arm.block_half
    hand.add_site(name="grasp", pos=[0, reach, 0])
    for kind in ("FORCE", "TORQUE"):
        spec.add_sensor(
            name=kind.lower(),
            type=getattr(mujoco.mjtSensor, f"mjSENS_{kind}"),
            objtype=mujoco.mjtObj.mjOBJ_SITE,
            objname="flange",
        )
    _add_block(spec, arm, reach)


def _add_block(spec: Any, arm: ArmParameters, reach: float) -> None:
    """A separate body. The fingers hold it while the equality `grip` is active."""
    block = spec.worldbody.add_body(name="block")
    block.add_freejoint(name="block")
    geom = block.add_geom(
        name="block",
        type=_GEOM.mjGEOM_BOX,
        size=[arm.block_half] * 3,
        mass=arm.block_mass,
    )
    geom.rgba = [0.2, 0.4, 0.9, 1]
    Contact(0.8, arm.contact_time).apply(geom)
    grip = spec.add_equality(
        name=GRIP,
        type=mujoco.mjtEq.mjEQ_WELD,
        objtype=mujoco.mjtObj.mjOBJ_BODY,
        name1="hand",
        name2="block",
    )
    grip.data[:11] = [
        0,
        0,
        0,
        0,
        reach,
        0,
        1,
        0,
        0,
        0,
        1,
    ]  # anchor, place, turn, weight of the turn
    grip.solref = [arm.grip_time, 1.0]
