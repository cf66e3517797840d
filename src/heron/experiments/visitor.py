"""The person of experiment III: the person's path, and the person's hand that pushes the arm
aside.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from heron.robot import Arm
from heron.scene import PersonParameters
from heron.scene.person import LEGS, PERSON, stance
from heron.variants import Person

Point = tuple[float, float]
_REACH = 1.0  # m: the farthest distance at which a person reaches for the arm


@dataclass(frozen=True)
class Leg:
    """A straight part of a walk: from when to when (s), and from where to where."""

    begin_s: float
    end_s: float
    start: Point
    end: Point


@dataclass(frozen=True)
class VisitorWalk:
    """The walk of a visitor. `stay_s` is the period (s) during which the visitor stands beside the
    arm.
    """

    legs: tuple[Leg, ...]
    stay_s: tuple[float, float] | None

    def at(self, now_s: float) -> tuple[Point, float, float]:
        """The visitor's position, heading (rad) and distance walked on the current leg (m)."""
        leg = next((one for one in self.legs if now_s < one.end_s), self.legs[-1])
        share = min(1.0, max(0.0, (now_s - leg.begin_s) / (leg.end_s - leg.begin_s)))
        x, y = (a + share * (b - a) for a, b in zip(leg.start, leg.end, strict=True))
        facing = math.atan2(leg.end[1] - leg.start[1], leg.end[0] - leg.start[0])
        return (x, y), facing, share * math.dist(leg.start, leg.end)


def varied(person: Person, generator: np.random.Generator) -> VisitorWalk:
    """The random part of the walk, by seed: the time of arrival, the speed, the distance and the
    duration.
    """
    begin_s = float(generator.uniform(3.0, 9.0))
    pace = float(generator.uniform(0.9, 1.4))
    radius = float(generator.uniform(0.85, 1.1))
    angle = math.radians(float(generator.uniform(-115.0, -60.0)))
    stay_s = float(generator.uniform(4.0, 8.0))
    if person is Person.OUTSIDE:
        return VisitorWalk(_legs([(5.0, -7.0), (5.0, 7.0)], pace, begin_s), None)
    beside = (radius * math.cos(angle), radius * math.sin(angle))
    path = [(6.0, 0.0), (4.0, 0.0), (1.6, -1.3), beside]
    there = _legs(path, pace, begin_s)
    left_s = there[-1].end_s + stay_s
    back = _legs(path[::-1], pace, left_s)
    return VisitorWalk((*there, *back), (there[-1].end_s, left_s))


def _legs(path: Sequence[Point], pace: float, begin_s: float) -> tuple[Leg, ...]:
    found = []
    for start, end in pairwise(path):
        end_s = begin_s + math.dist(start, end) / pace
        found.append(Leg(begin_s, end_s, start, end))
        begin_s = end_s
    return tuple(found)


class Visitor:
    """Walks. While the person stands next to the arm, the person tries to push the hand away."""

    period_ns = 20_000_000
    _PUSH = 15.0  # N
    _PUSH_S = (1.0, 2.0)  # after the arrival

    def __init__(self, arm: Arm, walk: VisitorWalk, person: PersonParameters) -> None:
        self._arm = arm
        self._walk = walk
        self._person = person
        self._limbs = [arm.model.body(name).mocapid[0] for name in (PERSON, *LEGS)]
        self._hand = arm.model.body("hand").id
        self.place: Point = walk.legs[0].start
        self.feet: tuple[Point, ...] = ()
        self.is_leading = False
        """They push the hand."""
        self.tick(0)

    def tick(self, now_ns: int) -> None:
        """A moment later."""
        now_s = now_ns * 1e-9
        self.place, facing, walked = self._walk.at(now_s)
        data = self._arm.data
        limbs, self.feet = stance(self._person, self.place, facing, walked)
        for index, limb in zip(self._limbs, limbs, strict=True):
            data.mocap_pos[index], data.mocap_quat[index] = limb
        push = self._push(now_s)
        self.is_leading = push != (0.0, 0.0)
        data.xfrc_applied[self._hand, :2] = push

    def _push(self, now_s: float) -> Point:
        """The force with which they push the hand: away from them."""
        if self._walk.stay_s is None:
            return (0.0, 0.0)
        since_s = now_s - self._walk.stay_s[0]
        x, y = self._arm.grasp[0] - self.place[0], self._arm.grasp[1] - self.place[1]
        distance = math.hypot(x, y)
        if not self._PUSH_S[0] <= since_s <= self._PUSH_S[1] or distance > _REACH:
            return (0.0, 0.0)
        return (self._PUSH * x / distance, self._PUSH * y / distance)
