"""A person: capsules that move without contact forces between person and arm.

The experiments measure the distance between arm and person, which contact forces would distort.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import mujoco

from heron.scene.ground import SEEN_GROUP

PERSON = "person"
LEGS = ("left_leg", "right_leg")
_GEOM = mujoco.mjtGeom
STRIDE = 0.7
"""The length of one swing of a leg (m)."""
_SWING = 0.45  # rad
_SKIN = (0.87, 0.68, 0.55, 1)
_CLOTHES = (0.9, 0.45, 0.15, 1)
_TROUSERS = (0.2, 0.25, 0.4, 1)


@dataclass(frozen=True)
class PersonParameters:
    """Lengths in m, for a person of 1.75 m."""

    hip_height: float = 0.88
    hip_half: float = 0.1
    leg_radius: float = 0.07
    shoulder_height: float = 1.4
    shoulder_half: float = 0.22
    torso_radius: float = 0.15
    arm_radius: float = 0.045
    head_radius: float = 0.11
    head_height: float = 1.64


class Limb(NamedTuple):
    """A body of a person: its place (m), and its turn as w, x, y, z."""

    place: tuple[float, float, float]
    turn: tuple[float, float, float, float]


class Stance(NamedTuple):
    """A walking person: the bodies, in the order of `PERSON` and `LEGS`, and the positions of the
    feet on the floor (m).
    """

    limbs: tuple[Limb, Limb, Limb]
    feet: tuple[tuple[float, float], tuple[float, float]]


def stance(
    person: PersonParameters, place: tuple[float, float], facing: float, walked: float
) -> Stance:
    """Place a person at a position (m), in a direction (rad), after a distance of walking (m)."""
    swing = _SWING * math.sin(math.pi * walked / STRIDE)
    (left, left_foot), (right, right_foot) = (
        _leg(person, place, facing, side, swing) for side in (1, -1)
    )
    body = Limb((*place, 0.0), _turned(facing, 0.0))
    return Stance((body, left, right), (left_foot, right_foot))


def _leg(
    person: PersonParameters, place: tuple[float, float], facing: float, side: int, swing: float
) -> tuple[Limb, tuple[float, float]]:
    """The leg of a side, and its foot."""
    x = place[0] - side * person.hip_half * math.sin(facing)
    y = place[1] + side * person.hip_half * math.cos(facing)
    ahead = -math.sin(side * swing) * person.hip_height
    foot = (x + ahead * math.cos(facing), y + ahead * math.sin(facing))
    return Limb((x, y, person.hip_height), _turned(facing, side * swing)), foot


def _turned(yaw: float, pitch: float) -> tuple[float, float, float, float]:
    """A quaternion w, x, y, z: turned on the floor, then swung forward or back."""
    cy, sy, cp, sp = math.cos(yaw / 2), math.sin(yaw / 2), math.cos(pitch / 2), math.sin(pitch / 2)
    return (cy * cp, -sy * sp, cy * sp, sy * cp)


def add_person(spec: Any, person: PersonParameters) -> None:
    """A body that faces in the direction of its x, and two legs that swing by themselves."""
    body = spec.worldbody.add_body(name=PERSON, mocap=True)
    low = person.hip_height + person.torso_radius
    high = person.shoulder_height - person.torso_radius
    _add_capsule(body, (0, 0, low, 0, 0, high), person.torso_radius, _CLOTHES)
    neck = (0, 0, person.shoulder_height, 0, 0, person.head_height)
    _add_capsule(body, neck, person.arm_radius, _SKIN)
    for side in (-1, 1):
        y = side * person.shoulder_half
        ends = (0, y, person.hip_height, 0, y, person.shoulder_height)
        _add_capsule(body, ends, person.arm_radius, _CLOTHES)
    head = body.add_geom(
        type=_GEOM.mjGEOM_SPHERE,
        pos=[0, 0, person.head_height],
        size=[person.head_radius, 0, 0],
    )
    _make_visible(head, _SKIN)
    for name in LEGS:
        leg = spec.worldbody.add_body(name=name, mocap=True)
        foot = person.leg_radius - person.hip_height
        _add_capsule(leg, (0, 0, foot, 0, 0, 0), person.leg_radius, _TROUSERS)


def _add_capsule(
    body: Any, ends: tuple[float, ...], radius: float, color: tuple[float, ...]
) -> None:
    geom = body.add_geom(type=_GEOM.mjGEOM_CAPSULE, fromto=ends, size=[radius, 0, 0])
    _make_visible(geom, color)


def _make_visible(geom: Any, color: tuple[float, ...]) -> None:
    geom.rgba = color
    geom.group = SEEN_GROUP
    geom.contype = geom.conaffinity = 0
