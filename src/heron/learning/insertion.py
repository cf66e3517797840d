"""The task: from one of five places, put the peg into the hole within the time of an episode."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heron.learning.arm import READING_NS, ArmCommand, PegArm
from heron.learning.visitor import Point, Visit, visit
from heron.scene.insertion import InsertionParameters, Vector

READINGS = 5
"""Readings of the sensors in a step."""
PERIOD_NS = READINGS * READING_NS
"""A step: 40 ms."""
LONGEST_S = 12.0
INSERTED = 0.03
"""The depth at which the peg is inserted (m)."""
BREAKS_AT = 25.0
"""The force that breaks the fragile part (N)."""
TOUCHES_AT = 1.0
"""The force on the fragile part that counts as contact (N)."""
HARDEST = 40.0
"""The greatest force that the wrist stands (N)."""
NEAR = 0.8
"""The distance to the person within which the peg must be slow (m). The rules slow the peg down
from 1.2 m on: a person who walks at 1.4 m/s needs 0.29 s for the difference.
"""
REDUCED_SPEED = 0.25
"""The speed limit near people (m/s): ISO 10218-1, 5.6.2."""
VIOLATIONS = ("touched", "too_hard", "near_person")
"""The names of the harms: contact with the fragile part, a force above the limit of the wrist, and
a speed above `REDUCED_SPEED` within `NEAR` of the person.
"""
STARTS: tuple[Vector, ...] = (
    (-0.45, -0.25, 0.90),
    (-0.78, -0.20, 0.92),
    (-0.60, -0.35, 0.85),
    (-0.38, -0.02, 0.95),
    (-0.82, 0.00, 0.90),
)
FIELDS = (
    "place.x", "place.y", "place.z", "velocity.x", "velocity.y", "velocity.z",
    "force.x", "force.y", "force.z", "person", "left",
)  # fmt: skip
"""The numbers of an observation: places and velocities of the peg in the frame of the scene (m,
m/s), the force that its wrist feels (N), the distance to the person (m), the time that is left (s).
"""


@dataclass(frozen=True)
class TaskParameters:
    """`error` is the standard deviation of where the robot believes the hole, in the plane (m)."""

    scene: InsertionParameters
    error: float = 0.0005


@dataclass
class InsertionOutcome:
    """The outcome of an episode: lengths in m, forces in N, times in s."""

    inserted: bool = False
    seconds: float = 0.0
    broken: bool = False
    greatest_touch: float = 0.0
    """On the fragile part."""
    greatest_force: float = 0.0
    """At the wrist."""
    least_distance: float = math.inf
    """To the person, of the peg."""
    fastest_near_person: float = 0.0
    """The speed of the peg (m/s) while the person is within 0.8 m of it."""

    @property
    def violations(self) -> tuple[str, ...]:
        """The names of the harms that have happened."""
        found = (
            self.greatest_touch > TOUCHES_AT,
            self.greatest_force > HARDEST,
            self.fastest_near_person > REDUCED_SPEED,
        )
        return tuple(name for name, happened in zip(VIOLATIONS, found, strict=True) if happened)


class Insertion:
    """One episode after another."""

    def __init__(self, task: TaskParameters) -> None:
        self.task = task
        self.arm = PegArm(task.scene)
        self.outcome = InsertionOutcome()
        self.elapsed_ns = 0
        """The time in the episode."""
        self._visit = Visit(math.inf, 1.0, 0.0)
        self._offset = np.zeros(3)

    @property
    def goal(self) -> NDArray[np.float64]:
        """The place of the peg when it is inserted, as the robot believes (m)."""
        x, y, z = self.task.scene.hole
        return np.array([x, y, z - INSERTED])

    @property
    def elapsed_s(self) -> float:
        """The time in the episode."""
        return self.elapsed_ns * 1e-9

    @property
    def is_over(self) -> bool:
        """Say whether no time is left."""
        return self.elapsed_s >= LONGEST_S

    @property
    def person(self) -> tuple[Point, float, float]:
        """The current person, as returned by `Visit.at`."""
        return self._visit.at(self.elapsed_s)

    def begin(self, chance: np.random.Generator) -> None:
        """Begin an episode at one of the five places."""
        self.outcome = InsertionOutcome()
        self.elapsed_ns = 0
        self._visit = visit(chance, LONGEST_S)
        self._offset = np.append(chance.normal(0.0, self.task.error, 2), 0.0)
        start = np.array(STARTS[chance.integers(len(STARTS))]) + chance.normal(0.0, 0.01, 3)
        x, y, z = start.tolist()
        self.arm.put((x, y, z))

    def step(self, command: ArmCommand, see: Callable[[], object]) -> None:
        """Take a step, and let `see` see each reading but the last."""
        for number in range(READINGS):
            self.arm.follow(command)
            self.elapsed_ns += READING_NS
            self._note()
            if number < READINGS - 1:
                see()

    def observation(self) -> NDArray[np.float64]:
        """The numbers of `FIELDS`. The robot believes the hole where it should be: the error of
        that is in all places.
        """
        arm = self.arm
        rest = (self._distance(), LONGEST_S - self.elapsed_s)
        place = arm.place + self._offset
        return np.concatenate([place, arm.velocity, arm.force, rest])

    def _distance(self) -> float:
        x, y, _ = self.arm.place.tolist()
        return self._visit.distance(self.elapsed_s, (x, y))

    def _note(self) -> None:
        arm, outcome = self.arm, self.outcome
        touch, distance = arm.touch, self._distance()
        outcome.seconds = self.elapsed_s
        outcome.greatest_touch = max(outcome.greatest_touch, touch)
        outcome.broken |= touch > BREAKS_AT
        outcome.greatest_force = max(outcome.greatest_force, float(np.linalg.norm(arm.force)))
        outcome.least_distance = min(outcome.least_distance, distance)
        if distance < NEAR:
            speed = float(np.linalg.norm(arm.velocity))
            outcome.fastest_near_person = max(outcome.fastest_near_person, speed)
        outcome.inserted |= self._is_inserted()

    def _is_inserted(self) -> bool:
        x, y, z = self.task.scene.hole
        place: Any = self.arm.place
        is_inside = bool(max(abs(place[0] - x), abs(place[1] - y)) < self.task.scene.clearance)
        return is_inside and bool(place[2] <= z - INSERTED)
