"""Whole scenes, as MuJoCo specifications before compilation."""

from __future__ import annotations

from typing import Any

import mujoco

from heron.scene.base import BaseParameters, add_base
from heron.scene.course import Course, add_course

STEP_NS = 2_000_000
"""The step of the physics: hard wheels on hard ground need 500 Hz."""


def new_spec() -> Any:
    """An empty scene with the physics that all scenes share."""
    spec = mujoco.MjSpec()
    spec.modelname = "heron"
    spec.option.timestep = STEP_NS * 1e-9
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.worldbody.add_light(pos=[3, 0, 6], dir=[0, 0, -1])
    return spec


def build_navigation(built: Course, base: BaseParameters) -> Any:
    """The base at the start of the course."""
    spec = new_spec()
    add_base(spec, base, add_course(spec, built))
    return spec
