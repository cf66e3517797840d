"""The insertion as a behavior tree; its numbers are what Mayr et al. (2022) learn."""

import math

from ezskiros import SkillDescription
from heron.learning.skills.hand import HAND

NEAR = 0.004
INSIDE = -0.029
"""A peg that is lower is in the hole (m)."""


class Approach(SkillDescription):
    """Moves the peg above the hole.

    Args:
        Height: over the hole (m).
        AsideX: of the hole, along x (m).
        AsideY: of the hole, along y (m).

    """

    def description(self, Height: float, AsideX: float, AsideY: float):
        pass


class approach(Approach.SkillBase):
    def execute(self):
        goal = (self.params.AsideX, self.params.AsideY, self.params.Height)
        if HAND.get().go_to(goal, 0.3) > NEAR:
            return self.step("above the hole")
        return self.success("it is above the hole")


class Search(SkillDescription):
    """Pushes the peg down, and moves it in a spiral until it falls into the hole.

    Args:
        Force: of the push (N).
        Growth: of the spiral, in each turn (m).
        Speed: along the spiral (m/s).

    """

    def description(self, AsideX: float, AsideY: float, Force: float, Growth: float, Speed: float):
        pass


class search(Search.SkillBase):
    def onStart(self):
        self.angle = 0.0
        self.before = HAND.get().seconds
        return True

    def execute(self):
        hand = HAND.get()
        radius = self.params.Growth * self.angle / (2 * math.pi)
        elapsed, self.before = hand.seconds - self.before, hand.seconds
        self.angle += elapsed * self.params.Speed / max(radius, self.params.Growth / 4, 1e-4)
        x = self.params.AsideX + radius * math.cos(self.angle)
        y = self.params.AsideY + radius * math.sin(self.angle)
        hand.go_to((x, y, hand.place[2]), 0.1)
        hand.push = -self.params.Force
        if hand.place[2] > INSIDE:
            return self.step("searching")
        return self.success("it is in the hole")


class Insert(SkillDescription):
    """Puts the peg into the hole."""

    def description(
        self,
        Height: float,
        AsideX: float,
        AsideY: float,
        Force: float,
        Growth: float,
        Speed: float,
    ):
        pass


class insert(Insert.SkillBase):
    def expandBT(self, params):
        self.serialstar(
            Approach(Height=params.Height, AsideX=params.AsideX, AsideY=params.AsideY),
            Approach(Height=0.005, AsideX=params.AsideX, AsideY=params.AsideY),
            Search(
                AsideX=params.AsideX,
                AsideY=params.AsideY,
                Force=params.Force,
                Growth=params.Growth,
                Speed=params.Speed,
            ),
        )
