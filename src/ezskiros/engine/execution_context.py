"""The context that all running skills of a task share."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from ezskiros.engine.events import Event, Reason
from ezskiros.engine.expansion import Expansions
from ezskiros.engine.inference import Solution
from ezskiros.engine.options import Locks
from ezskiros.engine.plans import ChildPlans
from ezskiros.engine.running import RunningSkills
from ezskiros.engine.world import World
from ezskiros.engine.world_model import WorldModel
from ezskiros.skills.interface import SkillInterface
from ezskiros.trees.library import Library

Choose = Callable[[SkillInterface, Sequence[Solution]], Solution]
"""Picks one of several solutions for inferred parameters."""
Guard = Callable[[str], str | None]
"""The reason why a skill, given by name, has to wait before it starts; None if it may start."""


def _first(_skill: SkillInterface, solutions: Sequence[Solution]) -> Solution:
    return solutions[0]


@dataclass
class ExecutionContext:
    """The world, the library, and the mode of execution."""

    library: Library
    world: World
    tell: Callable[[Event], None] = lambda _: None
    simulate: bool = False
    """True if primitives only apply their post-conditions."""
    compatible: bool = False
    """True if the engine behaves like SkiROS2, including its defects."""
    choose: Choose = _first
    clock: Callable[[], float] = time.monotonic
    """A clock in seconds."""
    expansions: Expansions = field(default_factory=Expansions)
    last_failure: Reason | None = None
    """The reason of the last failure, which also makes the parents fail."""
    guard: Guard | None = None
    """Checked before each start of a primitive."""

    def __post_init__(self) -> None:
        self.plans = ChildPlans(self.library)
        self.locks = Locks()
        self.running = RunningSkills()
        self.world_model = WorldModel(self.world)
