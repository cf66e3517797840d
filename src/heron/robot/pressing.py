"""Motions with intended contact: pushing a thing, and wiping a board.

Both are compliant in one direction. At their end both leave the touched thing, so the next motion
starts in free space.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from heron.robot.physics import Floats


class Pressing(Protocol):
    """A motion in contact, which can be begun again and again."""

    @property
    def is_over(self) -> bool:
        """True after the pressing is complete and the hand has left the surface."""

    def begin(self, place: Floats) -> None:
        """Begin at the current position of the grasp (m)."""

    def step(self, grasp: Floats, force: Floats, step_s: float, pace: float) -> Floats:
        """The place to which the servos bring the grasp (m), one step later. `force` (N) pushes
        the hand; `pace` is the share of its speed that the motion may have.
        """


@dataclass
class _Lean:
    """A mass (kg) with a damper (N s/m) that is driven against the felt force: its depth (m)."""

    mass: float
    damping: float
    depth: float = 0.0
    speed: float = 0.0

    def step(self, drive: float, felt: float, step_s: float) -> None:
        """One step later, with forces in N."""
        self.speed += (drive - felt - self.damping * self.speed) / self.mass * step_s
        self.depth += self.speed * step_s


@dataclass(frozen=True)
class PushParameters:
    """Speeds in m/s, lengths in m, forces in N, stiffness in N/m, damping in N s/m, mass in kg."""

    speed: float = 0.03
    approach: float = 0.015
    """The speed until it touches something."""
    touch: float = 3.0
    most: float = 120.0
    """The largest pushing force, against any obstacle."""
    stiffness: float = 300.0
    damping: float = 600.0
    mass: float = 12.0
    reached: float = 0.002
    leaves: float = 0.025
    leaving_speed: float = 0.05


class PushMotion:
    """Pushes the thing in front of the hand, until the grasp is at `end` (m)."""

    def __init__(self, end: Floats, parameters: PushParameters) -> None:
        self._end = end
        self._parameters = parameters

    @property
    def is_over(self) -> bool:
        """True after the thing is at its place and the hand has left it."""
        return self._left is not None and self._lean.depth <= self._left

    def begin(self, place: Floats) -> None:
        """Begin at the current position of the grasp (m)."""
        found, offset = self._parameters, self._end - place
        self._start, self._far = place.copy(), float(np.linalg.norm(offset))
        self._along = offset / max(self._far, 1e-9)
        self._lean = _Lean(found.mass, found.damping)
        self._wanted = found.approach * found.damping / found.stiffness  # from the start
        self._has_touched = False
        self._left: float | None = None

    def step(self, grasp: Floats, force: Floats, step_s: float, pace: float) -> Floats:
        """The wanted depth runs ahead of the hand, as far as the greatest force allows."""
        found, lean = self._parameters, self._lean
        if self._left is not None:
            lean.depth -= pace * found.leaving_speed * step_s
        else:
            felt = -float(force @ self._along)
            self._has_touched = self._has_touched or felt > found.touch
            speed = found.speed if self._has_touched else found.approach
            ahead = found.most / found.stiffness
            self._wanted = min(self._wanted + pace * speed * step_s, lean.depth + ahead)
            lean.step(found.stiffness * (self._wanted - lean.depth), felt, pace * step_s)
            passed = float((grasp - self._start) @ self._along)
            if self._far - passed < found.reached:
                self._left = passed - found.leaves
        place: Floats = self._start + lean.depth * self._along
        return place


@dataclass(frozen=True)
class WipeParameters:
    """Forces in N, speeds in m/s, acceleration in m/s^2, lengths in m, damping in N s/m, mass in
    kg.
    """

    press: float = 19.0
    touch: float = 9.0
    """The least force for a stroke."""
    speed: float = 0.1
    acceleration: float = 0.15
    damping: float = 2500.0
    mass: float = 40.0
    leaves: float = 0.03
    leaving_speed: float = 0.05


class WipeMotion:
    """Presses in the direction of `normal`, and strokes along a path of positions (m). Their
    distance from the board does not matter.
    """

    def __init__(self, path: Sequence[Floats], normal: Floats, parameters: WipeParameters) -> None:
        self._path = [self._flat(place, normal) for place in path]
        self._normal = normal
        self._parameters = parameters

    @property
    def is_over(self) -> bool:
        """True after the whole path is wiped and the hand has left the board."""
        return self._left is not None and self._lean.depth <= self._left

    def begin(self, place: Floats) -> None:
        """Begin at the current position of the grasp (m)."""
        found = self._parameters
        self._lean = _Lean(found.mass, found.damping, float(place @ self._normal))
        self._on_board = self._flat(place, self._normal)
        self._next = 0
        self._speed = 0.0
        self._left: float | None = None

    def step(self, grasp: Floats, force: Floats, step_s: float, pace: float) -> Floats:
        """Along the board it goes by places, into it by forces."""
        found, lean = self._parameters, self._lean
        felt = -float(force @ self._normal)
        if self._left is not None:
            lean.depth -= pace * found.leaving_speed * step_s
        else:
            lean.step(found.press, felt, pace * step_s)
            if felt > found.touch:
                self._stroke(pace * step_s)
            if self._next == len(self._path):
                self._left = float(grasp @ self._normal) - found.leaves
        return self._on_board + lean.depth * self._normal

    def _stroke(self, step_s: float) -> None:
        """Move to the next position of the path, from rest at each position."""
        found = self._parameters
        self._speed = min(found.speed, self._speed + found.acceleration * step_s)
        most = self._speed * step_s
        left = self._path[self._next] - self._on_board
        distance = float(np.linalg.norm(left))
        if distance <= most:
            self._on_board = self._path[self._next]
            self._next += 1
            self._speed = 0.0
        else:
            self._on_board = self._on_board + left * (most / distance)

    @staticmethod
    def _flat(place: Floats, normal: Floats) -> Floats:
        """The part of a place that is along the board."""
        found: Floats = place - (place @ normal) * normal
        return found
