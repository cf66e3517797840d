"""The used parts of SkiROS2's Python packages, located when SkiROS2 runs.

The branches for ROS 1 and ROS 2 have the same names for them. They are not imported earlier, so
that skills can be checked without SkiROS2.
"""

from __future__ import annotations

import importlib
import sys
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

_RUNNING = "skiros2_skill.core.skill_instanciator"


@dataclass(frozen=True)
class Api:
    """Classes and functions of SkiROS2, by their SkiROS2 names."""

    SkillDescription: Any
    SkillBase: Any
    SkillWrapper: Any
    PrimitiveBase: Any
    Element: Any
    ParamTypes: Any
    ParamHandler: Any
    State: Any
    Root: Any
    VisitorExecutor: Any
    processors: Any
    log: Any


def is_running() -> bool:
    """Say whether SkiROS2 has been imported. Otherwise another program loads the library."""
    return _RUNNING in sys.modules


def ticker() -> Any:
    """The class that ticks the tasks of SkiROS2. Raises `ImportError` without a skill manager."""
    return importlib.import_module("skiros2_skill.ros.skill_manager").BtTicker


@lru_cache(maxsize=1)
def api() -> Api:
    """The API of SkiROS2. Raises `ImportError` if SkiROS2 is not installed."""
    skill = importlib.import_module("skiros2_skill.core.skill")
    params = importlib.import_module("skiros2_common.core.params")
    return Api(
        SkillDescription=skill.SkillDescription,
        SkillBase=skill.SkillBase,
        SkillWrapper=skill.SkillWrapper,
        PrimitiveBase=importlib.import_module("skiros2_common.core.primitive").PrimitiveBase,
        Element=importlib.import_module("skiros2_common.core.world_element").Element,
        ParamTypes=params.ParamTypes,
        ParamHandler=params.ParamHandler,
        State=importlib.import_module("skiros2_common.core.abstract_skill").State,
        Root=skill.Root,
        VisitorExecutor=importlib.import_module("skiros2_skill.core.visitors").VisitorExecutor,
        processors=importlib.import_module("skiros2_skill.core.processors"),
        log=importlib.import_module("skiros2_common.tools.logger"),
    )
