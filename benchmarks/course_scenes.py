"""The scenes of the course: the walls, the people, and the goal of the planner."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from course_shapes import Outline, Pose, Round, Wall

HALF_LENGTH, HALF_WIDTH = 0.25, 0.2
OUTLINE = Outline(HALF_LENGTH, HALF_WIDTH)
"""The outline of the base (m). Its center is the origin of the frame of the base."""

SPEED, BRAKING, GAINING = 0.8, 1.2, 0.8
"""The speed of the planner on free ground (m/s), and the limits of the brakes and of
the drive (m/s^2).
"""

PERSON_M = 0.25
ORIGIN = Pose(0.0, 0.0, 0.0)
SECONDS_TO_SPEED, METERS_TO_SPEED = SPEED / GAINING, SPEED**2 / (2 * GAINING)


@dataclass(frozen=True)
class Person:
    """A person, or another round obstacle, on a straight path."""

    start: tuple[float, float]
    velocity: tuple[float, float]
    begins_s: float
    stays_s: tuple[float, float] = (math.inf, math.inf)
    """The person stands still between these instants."""

    def at(self, time_s: float, pose: Pose) -> tuple[float, float]:  # noqa: ARG002
        """The position at an instant."""
        walked = max(0.0, time_s - self.begins_s)
        since, until = self.stays_s
        walked -= max(0.0, min(time_s, until) - since) if time_s > since else 0.0
        return self.start[0] + walked * self.velocity[0], self.start[1] + walked * self.velocity[1]


@dataclass(frozen=True)
class Follower:
    """A person who walks behind the base at a constant distance."""

    behind_m: float

    def at(self, time_s: float, pose: Pose) -> tuple[float, float]:  # noqa: ARG002
        """The position at an instant."""
        far = HALF_LENGTH + self.behind_m + PERSON_M
        return pose.x - far * math.cos(pose.heading), pose.y - far * math.sin(pose.heading)


@dataclass(frozen=True)
class Scene:
    """A scene with the random numbers of one run."""

    walls: tuple[Wall, ...] = ()
    people: tuple[Person | Follower, ...] = ()
    start: Pose = ORIGIN
    goal_m: float = 20.0
    """The planner stops here. It knows nothing about walls and people."""
    creep_m: float = 0.0
    """The distance before the goal that the planner drives slowly."""
    seconds: float = 12.0
    is_passable: bool = False
    """True if nothing in the scene requires a stop."""
    no_return: float = math.inf
    """The reading of a beam that does not return."""
    lost_share: float = 0.0
    """The share of the other beams that have this reading, too."""
    silent_from_s: float = math.inf

    def people_at(self, time_s: float, pose: Pose) -> list[Round]:
        """The people at an instant."""
        return [(*person.at(time_s, pose), PERSON_M) for person in self.people]


def arrival_s(distance_m: float) -> float:
    """The time at which the front of an unhindered base has travelled a distance in m."""
    return SECONDS_TO_SPEED + (distance_m - METERS_TO_SPEED) / SPEED


def wall_ahead(random: np.random.Generator) -> Scene:
    """A wall stands across the path of the base, at a small angle."""
    x, tilt = random.uniform(4.0, 5.0), random.uniform(-0.5, 0.5)
    return Scene(((x - tilt, -3.0, x + tilt, 3.0),))


def person_crosses(random: np.random.Generator) -> Scene:
    """A person crosses an empty hall. Without a guard, the base drives into the person."""
    x, lead = random.uniform(3.5, 4.5), random.uniform(0.6, 0.8)
    pace, begin = 0.7, 3.0
    enters_s = arrival_s(x - PERSON_M - lead - HALF_LENGTH)
    walk_s = (begin - HALF_WIDTH - PERSON_M) / pace
    person = Person((x, -begin), (0.0, pace), enters_s - walk_s)
    return Scene(people=(person,), goal_m=7.0, seconds=16.0)


def person_steps_out(random: np.random.Generator) -> Scene:
    """A person steps out from behind a wall, stops in front of the base, and walks on."""
    x, lead = random.uniform(3.5, 4.5), random.uniform(0.6, 0.8)
    pace, begin = 1.4, 1.2
    enters_s = arrival_s(x - PERSON_M - lead - HALF_LENGTH)
    begins_s = enters_s - (begin - HALF_WIDTH - PERSON_M) / pace
    stays_s = begins_s + begin / pace
    person = Person((x, -begin), (0.0, pace), begins_s, (stays_s, stays_s + 3.0))
    wall = (-2.0, -0.6, x - 0.4, -0.6)
    return Scene((wall,), (person,), goal_m=7.0, seconds=18.0)


def narrow_corridor(random: np.random.Generator) -> Scene:
    """A corridor is slightly wider than the base, and the base enters it at a small angle."""
    half = HALF_WIDTH + 0.15
    sides = [(2.0, side * half, 7.0, side * half) for side in (1, -1)]
    fronts = [(2.0, side * half, 2.0, side * 3.0) for side in (1, -1)]
    start = Pose(0.0, random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03))
    return Scene((*sides, *fronts), start=start, goal_m=8.5, seconds=24.0, is_passable=True)


def readings_of_zero(random: np.random.Generator) -> Scene:
    """A wall stands ahead. The lidar sends 0 if a beam does not return."""
    x = random.uniform(4.0, 5.0)
    return Scene(((x, -3.0, x, 3.0),), no_return=0.0, lost_share=0.05)


def silent_lidar(random: np.random.Generator) -> Scene:
    """A wall stands ahead. The lidar falls silent while the wall is still beyond all zones."""
    x = random.uniform(4.5, 5.0)
    silent_s = arrival_s(x - HALF_LENGTH - random.uniform(1.9, 2.1))
    return Scene(((x, -3.0, x, 3.0),), silent_from_s=silent_s)


def someone_behind(random: np.random.Generator) -> Scene:
    """A person follows the base closely. Nothing stands in front of the base."""
    follower = Follower(random.uniform(0.2, 0.3))
    return Scene(people=(follower,), goal_m=6.0, seconds=12.0, is_passable=True)


def docking_station(random: np.random.Generator) -> Scene:
    """The base docks: it drives slowly until it nearly touches the docking station."""
    x, half = random.uniform(3.0, 3.5), HALF_WIDTH + 0.08
    face = [(x, -half, x, half)]
    sides = [(x - 0.35, side * half, x, side * half) for side in (1, -1)]
    goal = x - HALF_LENGTH - 0.03
    return Scene((*face, *sides), goal_m=goal, creep_m=0.5, seconds=16.0, is_passable=True)


SCENES: Mapping[str, Callable[[np.random.Generator], Scene]] = {
    "wall ahead": wall_ahead,
    "person crosses": person_crosses,
    "person steps out": person_steps_out,
    "narrow corridor": narrow_corridor,
    "readings of 0": readings_of_zero,
    "lidar falls silent": silent_lidar,
    "someone behind": someone_behind,
    "docking station": docking_station,
}
"""The scenes by their names. The generator yields the random numbers of one run."""
