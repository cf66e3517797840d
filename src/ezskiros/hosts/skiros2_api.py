"""The used parts of SkiROS2's Python packages, located when SkiROS2 runs.

The branches for ROS 1 and ROS 2 have the same names for it. Nothing of it is imported before, so
that skills are checked where there is no SkiROS2.
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
    """Classes and functions of SkiROS2, by their names there."""

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
    """Say whether SkiROS2 has been imported: only then can it be what loads a library."""
    return _RUNNING in sys.modules


def ticker() -> Any:
    """The class that ticks the tasks of SkiROS2. Raises `ImportError` without a skill manager."""
    return importlib.import_module("skiros2_skill.ros.skill_manager").BtTicker


@lru_cache(maxsize=1)
def api() -> Api:
    """SkiROS2. Raises `ImportError` where it is not installed."""
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
