"""The interface between primitive skills and the arm: the caller of a tick sets the hand."""

from __future__ import annotations

import math
from contextvars import ContextVar
from dataclasses import dataclass, field

Vector = tuple[float, float, float]


@dataclass
class Hand:
    """The last reading, and the command for the next step: a velocity (m/s), and a force along z
    (N). Positions are positions of the peg relative to the hole (m).
    """

    place: Vector = (0.0, 0.0, 0.0)
    seconds: float = 0.0
    """The time in the episode."""
    velocity: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    push: float = 0.0

    def go_to(self, goal: Vector, fastest: float) -> float:
        """Command a motion to a place. Returns the distance (m)."""
        offset = [there - here for there, here in zip(goal, self.place, strict=True)]
        far = math.hypot(*offset)
        speed = min(fastest, 3.0 * far)
        self.velocity = [each / max(far, 1e-9) * speed for each in offset]
        self.push = 0.0
        return far


HAND: ContextVar[Hand] = ContextVar("hand")
