"""The insertion as a behavior tree of EzSkiROS with numbers to learn (Mayr et al., 2022)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import gymnasium
import numpy as np

from ezskiros.engine.expansion import Expansions
from ezskiros.engine.setting import Setting
from ezskiros.engine.task import Task
from ezskiros.runner import Ready, prepare
from heron.learning.environment import GREATEST, LEAST
from heron.learning.episodes import Tally
from heron.learning.insertion import LONGEST_S, Outcome
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
_FOLDER = Path(__file__).parent / "skills"
_HOLE = InsertionParameters().hole


class InsertionTree:
    """The tree, checked once."""

    def __init__(self) -> None:
        """Raises `FaultyError` if the skills have errors."""
        texts = [f"{name}={least}" for name, (least, _) in RANGES.items()]
        self._ready: Ready = prepare("Insert", [_FOLDER], None, texts)

    def episode(
        self, env: gymnasium.Env[Any, Any], numbers: Mapping[str, float], seed: int | None = None
    ) -> tuple[Outcome, Tally]:
        """Run an episode with these numbers."""
        ready, tally = self._ready, Tally()
        reached = hand.Hand()
        call = replace(ready.call, arguments=MappingProxyType(dict(numbers)))
        setting = Setting(
            ready.library,
            ready.world,
            clock=lambda: reached.seconds,
            expansions=Expansions(ready.trees),
        )
        task = Task(call, setting)
        seen, _ = env.reset(seed=seed)
        token = hand.HAND.set(reached)
        try:
            while True:
                x, y, z = (seen[:3] - _HOLE).tolist()
                reached.place, reached.seconds = (x, y, z), LONGEST_S - float(seen[-1])
                task.tick()
                action = np.array([*reached.velocity, reached.push], np.float32)
                seen, reward, terminated, truncated, info = env.step(
                    np.clip(action, LEAST, GREATEST)
                )
                tally.count(float(reward), info["guard"])
                if terminated or truncated:
                    return info["outcome"], tally
        finally:
            hand.HAND.reset(token)
