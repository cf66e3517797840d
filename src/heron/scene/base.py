"""The mobile base: modelled on a MiR100 with an arm on top, with the dimensions of its data sheet.

On each side a *rocker* carries the drive wheel and the front caster, so that the drive wheel stays
on the ground where the slope changes. With casters fixed to the chassis, the drive wheels lose
contact at the foot of a ramp of 12 degrees. Casters are balls that slide.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import mujoco

from heron.scene.ground import Contact

AXLES = ("front", "drive", "rear")
SIDES = ("left", "right")
_GEOM = mujoco.mjtGeom
_UNCOLLIDED = {"contype": 0, "conaffinity": 0}


@dataclass(frozen=True)
class BaseParameters:
    """Lengths in m, masses in kg, torques in Nm.

    x points forward, y to the left, z up; x = 0 is the axle of the drive wheels. The masses add up
    to 99 kg, as MiR100 with UR5e, control box and payload do.
    """

    wheel_radius: float = 0.0625
    wheel_half_width: float = 0.03
    half_track: float = 0.2
    front_x: float = 0.33
    rear_x: float = -0.33
    rocker_x: float = 0.11
    rocker_z: float = 0.11
    clearance: float = 0.09
    chassis_half: tuple[float, float, float] = (0.445, 0.29, 0.1)
    chassis_mass: float = 70.0
    tower_mass: float = 20.0
    tower_z: float = 0.49
    wheel_mass: float = 2.0
    caster_mass: float = 1.0
    rocker_mass: float = 0.5
    caster_friction: float = 0.01
    torque: float = 6.0
    """The usual torque limit of each drive wheel (Nm)."""
    boosted_torque: float = 13.0
    """The torque limit of each drive wheel after a request for more torque (Nm)."""
    gain: float = 12.0
    """The gain of the velocity servo on each wheel, in Nm s/rad."""
    imu_z: float = 0.2
    scanner_z: float = 0.2

    @property
    def mass(self) -> float:
        """The total mass (kg)."""
        wheels = 2 * (self.wheel_mass + self.rocker_mass) + 4 * self.caster_mass
        return self.chassis_mass + self.tower_mass + wheels


def add_base(spec: Any, base: BaseParameters, contact: Contact) -> None:
    """The base at the origin, its velocity servos and its accelerometers."""
    body = spec.worldbody.add_body(name="base")
    body.add_freejoint(name="base")
    _add_chassis(body, base, contact)
    for side, sign in zip(SIDES, (1, -1), strict=True):
        _add_side(spec, body, base, contact, side, sign * base.half_track)
    body.add_site(name="imu", pos=[0, 0, base.imu_z])
    body.add_site(name="scanner", pos=[0, 0, base.scanner_z])
    for name, kind in (("acceleration", "ACCELEROMETER"), ("gyro", "GYRO")):
        _add_sensor(spec, name, kind, "imu")


def _add_chassis(body: Any, base: BaseParameters, contact: Contact) -> None:
    half = base.chassis_half
    chassis = body.add_geom(
        name="chassis",
        type=_GEOM.mjGEOM_BOX,
        size=half,
        pos=[0, 0, base.clearance + half[2]],
        mass=base.chassis_mass,
    )
    Contact(friction=0.3, time_constant=contact.time_constant).apply(chassis)
    chassis.rgba = [0.85, 0.87, 0.9, 1]
    tower = body.add_geom(
        name="tower",
        type=_GEOM.mjGEOM_BOX,
        size=[0.1, 0.1, 0.2],
        pos=[0, 0, base.tower_z],
        mass=base.tower_mass,
        **_UNCOLLIDED,
    )
    tower.rgba = [0.25, 0.35, 0.55, 1]


def _add_side(
    spec: Any, body: Any, base: BaseParameters, contact: Contact, side: str, y: float
) -> None:
    radius = base.wheel_radius
    _add_caster(spec, body, base, contact, f"rear_{side}", (base.rear_x, y, radius))
    rocker = body.add_body(name=f"rocker_{side}", pos=[base.rocker_x, y, base.rocker_z])
    rocker.add_joint(
        name=f"rocker_{side}",
        type=mujoco.mjtJoint.mjJNT_HINGE,
        axis=[0, 1, 0],
        limited=True,
        range=[-20, 20],
        damping=[5, 0, 0],
    )
    down = radius - base.rocker_z
    front, drive = base.front_x - base.rocker_x, -base.rocker_x
    rocker.add_geom(
        type=_GEOM.mjGEOM_CAPSULE,
        size=[0.015, 0, 0],
        fromto=[drive, 0, down, front, 0, down],
        mass=base.rocker_mass,
        **_UNCOLLIDED,
    )
    _add_caster(spec, rocker, base, contact, f"front_{side}", (front, 0, down))
    _add_wheel(spec, rocker, base, contact, side, (drive, 0, down))


def _add_caster(
    spec: Any,
    body: Any,
    base: BaseParameters,
    contact: Contact,
    name: str,
    place: tuple[float, float, float],
) -> None:
    ball = body.add_geom(
        name=name,
        type=_GEOM.mjGEOM_SPHERE,
        size=[base.wheel_radius, 0, 0],
        pos=place,
        mass=base.caster_mass,
        priority=1,  # its friction counts, not that of the ground
    )
    Contact(base.caster_friction, contact.time_constant).apply(ball)
    ball.rgba = [0.2, 0.2, 0.2, 1]
    _add_axle(spec, body, name, place)


def _add_wheel(
    spec: Any,
    rocker: Any,
    base: BaseParameters,
    contact: Contact,
    side: str,
    place: tuple[float, float, float],
) -> None:
    name = f"wheel_{side}"
    wheel = rocker.add_body(name=name, pos=place)
    wheel.add_joint(
        name=name,
        type=mujoco.mjtJoint.mjJNT_HINGE,
        axis=[0, 1, 0],
        damping=[0.1, 0, 0],
        armature=0.05,
    )
    half_turn = math.sqrt(0.5)
    tire = wheel.add_geom(
        name=name,
        type=_GEOM.mjGEOM_CYLINDER,
        size=[base.wheel_radius, base.wheel_half_width, 0],
        quat=[half_turn, half_turn, 0, 0],
        mass=base.wheel_mass,
    )
    contact.apply(tire)
    tire.rgba = [0.1, 0.1, 0.1, 1]
    spec.add_exclude(bodyname1="base", bodyname2=name)  # a wheel is no child of the chassis
    servo = spec.add_actuator(
        name=name, target=name, trntype=mujoco.mjtTrn.mjTRN_JOINT, forcelimited=True
    )
    servo.set_to_velocity(kv=base.gain)
    servo.forcerange = [-base.torque, base.torque]
    _add_axle(spec, rocker, f"drive_{side}", place)


def _add_axle(spec: Any, body: Any, name: str, place: tuple[float, float, float]) -> None:
    """An accelerometer where a wheel or a caster is held."""
    body.add_site(name=name, pos=place)
    _add_sensor(spec, name, "ACCELEROMETER", name)


def _add_sensor(spec: Any, name: str, kind: str, site: str) -> None:
    spec.add_sensor(
        name=name,
        type=getattr(mujoco.mjtSensor, f"mjSENS_{kind}"),
        objtype=mujoco.mjtObj.mjOBJ_SITE,
        objname=site,
    )
