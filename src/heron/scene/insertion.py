"""The scene of figure 4 of the thesis: a peg, a block with a hole, a fragile part beside the hole,
and a person who shares the space.

The places are those of the public configuration of SkiREIL (Mayr et al., 2022). The peg hangs
upright from an arm; the scene only has the arm's inertia and compliance.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import mujoco

from heron.scene.ground import Contact
from heron.scene.person import PersonParameters, add_person
from heron.scene.scene import new_spec

STEP_NS = 4_000_000
"""The step of the physics: nothing in this scene is harder than its contacts."""
AXES = ("x", "y", "z")
PUSH = "push"
PEG, FRAGILE, BLOCK = "peg", "fragile", "block"
WRIST_FORCE, FRAGILE_TOUCH = "wrist_force", "fragile_touch"
_GEOM = mujoco.mjtGeom
_TIP = 0.004
"""The chamfer of the peg, in height (m)."""

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class InsertionParameters:
    """Lengths in m, masses in kg, stiffness in N/m. Boxes are given by their middle and halves."""

    clearance: float = 0.003
    """The difference of the widths of hole and peg."""
    hole: Vector = (-0.6, 0.0, 0.7)
    """The middle of the mouth of the hole."""
    depth: float = 0.05
    peg_half: float = 0.02
    """Half the width of the peg, which is square."""
    peg_length: float = 0.1
    peg_mass: float = 0.5
    arm_mass: float = 2.5
    """The inertia of the arm at its hand."""
    stiffness: float = 500.0
    """The compliance of the hand in the plane; along the axis, while nothing pushes."""
    push_damping: float = 200.0
    """The damping along the axis while the peg pushes, and its stiffness is 0 (N s/m)."""
    friction: float = 0.2
    contact_time: float = 0.02
    table: tuple[Vector, Vector] = ((-0.53, -0.1, 0.3), (0.4, 0.6, 0.3))
    block_half: float = 0.06
    fragile: tuple[Vector, Vector] = ((-0.52, 0.3, 0.75), (0.19, 0.15, 0.15))
    person: PersonParameters = field(default_factory=PersonParameters)


def build_insertion(scene: InsertionParameters) -> Any:
    """The peg at the origin of its axes. Each axis moves the peg in the frame of the scene. The
    position of the peg is the center of its lower end.
    """
    spec = new_spec()
    spec.option.timestep = STEP_NS * 1e-9
    contact = Contact(scene.friction, scene.contact_time)
    _add_box(spec.worldbody, scene.table, (0.8, 0.7, 0.55, 1), contact).name = "table"
    _add_block(spec, scene, contact)
    _add_fragile(spec, scene, contact)
    _add_peg(spec, scene, contact)
    add_person(spec, scene.person)
    return spec


def _add_box(
    body: Any, box: tuple[Vector, Vector], color: tuple[float, ...], contact: Contact
) -> Any:
    middle, half = box
    geom = body.add_geom(type=_GEOM.mjGEOM_BOX, pos=middle, size=half)
    geom.rgba = color
    contact.apply(geom)
    return geom


def _add_block(spec: Any, scene: InsertionParameters, contact: Contact) -> None:
    """Four walls around the hole, and the block below it."""
    x, y, top = scene.hole
    bottom = scene.table[0][2] + scene.table[1][2]
    inner, outer = scene.peg_half + scene.clearance / 2, scene.block_half
    middle, half = (inner + outer) / 2, (outer - inner) / 2
    high = (top - bottom) / 2
    boxes = []
    for side in (-1, 1):
        boxes.append(((x + side * middle, y, bottom + high), (half, outer, high)))
        boxes.append(((x, y + side * middle, bottom + high), (inner, half, high)))
    floor = (top - scene.depth - bottom) / 2
    boxes.append(((x, y, bottom + floor), (inner, inner, floor)))
    for number, box in enumerate(boxes):
        _add_box(spec.worldbody, box, (0.55, 0.57, 0.6, 1), contact).name = f"{BLOCK}_{number}"


def _add_fragile(spec: Any, scene: InsertionParameters, contact: Contact) -> None:
    """The fragile part, which measures contact forces."""
    middle, half = scene.fragile
    body = spec.worldbody.add_body(name=FRAGILE, pos=middle)
    _add_box(body, ((0.0, 0.0, 0.0), half), (0.8, 0.15, 0.15, 1), contact)
    margin = 0.01
    body.add_site(
        name=FRAGILE, type=_GEOM.mjGEOM_BOX, size=[each + margin for each in half]
    ).group = 5
    sensor = spec.add_sensor(name=FRAGILE_TOUCH, type=mujoco.mjtSensor.mjSENS_TOUCH)
    sensor.objtype, sensor.objname = mujoco.mjtObj.mjOBJ_SITE, FRAGILE


def _add_peg(spec: Any, scene: InsertionParameters, contact: Contact) -> None:
    """The hand on three axes, and the peg that it holds."""
    hand = spec.worldbody.add_body(name="hand", gravcomp=1)
    for number, axis in enumerate(AXES):
        direction = [float(number == each) for each in range(3)]
        hand.add_joint(name=axis, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=direction)
        _add_compliance(spec, scene, axis)
    push = spec.add_actuator(name=PUSH, target="z", trntype=mujoco.mjtTrn.mjTRN_JOINT)
    push.set_to_motor()
    grip = hand.add_geom(
        type=_GEOM.mjGEOM_CYLINDER,
        pos=[0, 0, scene.peg_length + 0.04],
        size=[0.035, 0.04, 0],
        mass=scene.arm_mass,
        contype=0,
        conaffinity=0,
    )
    grip.rgba = [0.25, 0.27, 0.3, 1]
    peg = hand.add_body(name=PEG, gravcomp=1)
    half, length = scene.peg_half, scene.peg_length
    color = (0.9, 0.7, 0.2, 1)
    shaft = ((0, 0, (length + _TIP) / 2), (half, half, (length - _TIP) / 2))
    tip = ((0, 0, _TIP / 2), (half - _TIP / 2, half - _TIP / 2, _TIP / 2))
    for box, mass in ((shaft, scene.peg_mass), (tip, 0.0)):
        _add_box(peg, box, color, contact).mass = mass
    peg.add_site(name=PEG, pos=[0, 0, length])
    sensor = spec.add_sensor(name=WRIST_FORCE, type=mujoco.mjtSensor.mjSENS_FORCE)
    sensor.objtype, sensor.objname = mujoco.mjtObj.mjOBJ_SITE, PEG


def _add_compliance(spec: Any, scene: InsertionParameters, axis: str) -> None:
    """A spring from where the arm wants its hand to where it is, critically damped."""
    mass = scene.arm_mass + scene.peg_mass
    spring = spec.add_actuator(name=axis, target=axis, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    spring.set_to_position(kp=scene.stiffness, kv=2.0 * (scene.stiffness * mass) ** 0.5)
