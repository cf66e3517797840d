"""The insertion as a behavior tree of EzSkiROS with numbers to learn (Mayr et al., 2022)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ezskiros.engine.execution_context import ExecutionContext
from ezskiros.engine.expansion import Expansions
from ezskiros.engine.task import Task
from ezskiros.runner import Ready, prepare
from heron.learning.environment import GREATEST, LEAST
from heron.learning.insertion import LONGEST_S
from heron.learning.skills import hand
from heron.scene.insertion import InsertionParameters

RANGES: Mapping[str, tuple[float, float]] = {
    "Height": (0.01, 0.1),
    "AsideX": (-0.02, 0.02),
    "AsideY": (-0.02, 0.02),
    "Force": (0.5, 10.0),
    "Growth": (0.0005, 0.008),
    "Speed": (0.005, 0.1),
}
"""The numbers that are learned, with their least and greatest values (m, N, m/s)."""
NUMBERS = "numbers.json"
"""The name of a file that holds those that were learned."""
_FOLDER = Path(__file__).parent / "skills"
_HOLE = InsertionParameters().hole
Floats = NDArray[Any]


class InsertionTree:
    """The tree, checked once."""

    def __init__(self) -> None:
        """Raises `FaultyError` if the skills have errors."""
        texts = [f"{name}={least}" for name, (least, _) in RANGES.items()]
        self._ready: Ready = prepare("Insert", [_FOLDER], None, texts)

    def policy(self, numbers: Mapping[str, float]) -> Callable[[Floats], Floats]:
        """A run of the tree with these numbers, for one episode: from each observation to the
        action of the skill that runs.
        """
        ready, reached = self._ready, hand.Hand()
        execution = ExecutionContext(
            ready.library,
            ready.world,
            clock=lambda: reached.seconds,
            expansions=Expansions(ready.trees),
        )
        task = Task(replace(ready.call, arguments=MappingProxyType(dict(numbers))), execution)

        def act(seen: Floats) -> Floats:
            x, y, z = (seen[:3] - _HOLE).tolist()
            reached.place, reached.seconds = (x, y, z), LONGEST_S - float(seen[-1])
            token = hand.HAND.set(reached)
            try:
                task.tick()
            finally:
                hand.HAND.reset(token)
            return np.clip([*reached.velocity, reached.push], LEAST, GREATEST).astype(np.float32)

        return act
