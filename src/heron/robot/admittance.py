"""Active compliance: the displacement of the arm by forces, `M a = F + K (wanted - x) - D v`."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from heron.robot.physics import Floats


@dataclass
class Admittance:
    """A mass (kg) on a spring (N/m) and a damper (N s/m), with a position and a velocity. With
    these numbers it is calm in the air, and oscillates against a hard table, because force readings
    are too late for such a spring. A softer spring oscillates less.
    """

    place: Floats
    stiffness: float = 500.0
    damping: float = 300.0
    mass: float = 4.0

    def __post_init__(self) -> None:
        self.velocity = np.zeros_like(self.place)

    def step(self, wanted: Floats, force: Floats, step_s: float) -> Floats:
        """Return the position after one time step."""
        push = force + self.stiffness * (wanted - self.place) - self.damping * self.velocity
        self.velocity = self.velocity + push / self.mass * step_s
        self.place = self.place + self.velocity * step_s
        return self.place

    def rest(self) -> None:
        """Stop at once."""
        self.velocity = np.zeros_like(self.place)
