"""The operator of experiment VI. The operator is called when the base stands still for too long,
arrives after a while, and removes the obstacle.
"""

from __future__ import annotations

import math

from heron.experiments.obstacles import Obstacles
from heron.robot import Base

_MOVES = 0.3  # m; a base with this progress is not standing


class ClearingOperator:
    """`visits` counts the operator interventions."""

    period_ns = 100_000_000
    PATIENCE_NS = 20_000_000_000
    """The base calls the operator after this time of standstill on its path."""

    def __init__(self, physics: Base, obstacles: Obstacles, delay_s: float) -> None:
        """The time from a call to the arrival of the operator (s)."""
        self._physics = physics
        self._obstacles = obstacles
        self._due_ns = self.PATIENCE_NS + round(delay_s * 1e9)
        self._stood = (math.inf, math.inf)
        self._since_ns = 0
        self.visits = 0

    def tick(self, now_ns: int) -> None:
        """Process the next instant. If the base continues before the operator arrives, the call is
        cancelled.
        """
        x, y, _ = self._physics.position.tolist()
        if math.dist((x, y), self._stood) > _MOVES:
            self._stood, self._since_ns = (x, y), now_ns
        elif now_ns - self._since_ns >= self._due_ns:
            self._obstacles.take_away(now_ns)
            self._since_ns = now_ns
            self.visits += 1
