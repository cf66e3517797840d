"""A course for guards of mobile bases: a base with a lidar drives along scenes, and a guard may
change each of its commands.

A guard is a function of the last scan, the last odometry, the command of the planner and the
instant. It returns the command for the base. All random numbers are seeded, so a guard always has
the same figures.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from functools import cache

import numpy as np
from course_scenes import (
    BRAKING,
    GAINING,
    OUTLINE,
    SCENES,
    SPEED,
    Scene,
)
from course_shapes import Around, Floats, Pose, gap, gap_ahead, ranges, seen_from
from numpy.typing import NDArray

TICK_S = 0.01
ODOMETRY_TICKS, COMMAND_TICKS, SCAN_TICKS = 2, 5, 10
"""Odometry has 50 Hz, commands have 20 Hz (as in Nav2), and scans have 10 Hz."""

DELAY_TICKS = 5
"""A scan arrives 50 ms after its stamp: half a turn of the lidar."""

BEAMS, RANGE_MIN, RANGE_MAX, NOISE = 360, 0.15, 12.0, 0.01
TURNING = 2.0
"""The angular acceleration of the base (rad/s^2)."""

NEAR_M = SPEED**2 / (2 * BRAKING) + SPEED * 1.0
"""A stop is right if an obstacle ahead is closer than this: the braking distance, plus the distance
of one second.
"""

SILENCE_S = 0.2
"""A stop is also right if no scan has arrived for this time: two scans are missing."""

NS = 1_000_000_000


@dataclass(frozen=True)
class Command:
    """Speeds for the base: m/s and rad/s."""

    linear: float
    angular: float


@dataclass(frozen=True)
class Scan:
    """Readings of the lidar at an instant in the frame of the base, as `sensor_msgs/LaserScan`."""

    stamp_ns: int
    ranges: NDArray[np.float32]
    angle_min: float = -math.pi
    angle_increment: float = 2 * math.pi / BEAMS
    range_min: float = RANGE_MIN
    range_max: float = RANGE_MAX


@dataclass(frozen=True)
class Odometry:
    """The pose and the velocity of the base at an instant."""

    stamp_ns: int
    pose: Pose
    moving: Command


Guard = Callable[["Scan | None", Odometry, Command, int], Command]


def unguarded(scan: Scan | None, odometry: Odometry, command: Command, at_ns: int) -> Command:  # noqa: ARG001
    """A guard that changes no command."""
    return command


@dataclass(frozen=True)
class Contender:
    """A guard with its name. `start` makes a new guard for each run.

    If a guard has the method `cpu_ns`, the method returns the CPU time of the guard so far.
    Otherwise the CPU time of the calls counts.
    """

    name: str
    start: Callable[[], AbstractContextManager[Guard]]


@dataclass(frozen=True)
class Outcome:
    """The measurements of one run."""

    reaction_s: float
    """The time from the instant at which the braking distance equals the free distance (for an
    unguarded base) to the first reduced command, in s; NaN if either never happened.
    """
    blind_s: float
    """The time from the instant at which the lidar fell silent to the first reduced command, in
    s.
    """
    least_gap_m: float
    contact_speed: float
    """The speed at which the base drove into an obstacle (m/s); 0 without a collision."""
    stops: int
    false_stops: int
    falsely_slow_s: float
    distance_m: float
    is_at_goal: bool
    cpu_ns_of_scan: float


def random_of(scene: str, seed: int) -> np.random.Generator:
    """The random numbers of one run of a scene."""
    return np.random.default_rng([list(SCENES).index(scene), seed])


def run(scene: str, contender: Contender, seed: int) -> Outcome:
    """Drive a scene once."""
    with contender.start() as guard:
        drive = _Drive(scene, guard, seed)
        drive.run()
    return drive.outcome(_latest_instant_s(scene, seed))


@cache
def _latest_instant_s(scene: str, seed: int) -> float:
    """The instant at which an unguarded base needs the whole free distance for braking; NaN if
    never.
    """
    drive = _Drive(scene, unguarded, seed)
    drive.run()
    return drive.latest_s


@dataclass
class _Base:
    """The base. Its brakes and its drive change its speed towards the speed of the command."""

    pose: Pose
    moving: Command = Command(0.0, 0.0)

    def move(self, command: Command) -> None:
        """Move for one tick."""
        before = self.moving
        change = command.linear - before.linear
        is_slower = change * before.linear < 0.0
        most = (BRAKING if is_slower else GAINING) * TICK_S
        linear = before.linear + max(-most, min(most, change))
        most = TURNING * TICK_S
        angular = before.angular + max(-most, min(most, command.angular - before.angular))
        pose = self.pose
        heading = pose.heading + angular * TICK_S
        distance = linear * TICK_S
        self.pose = Pose(
            pose.x + distance * math.cos(heading), pose.y + distance * math.sin(heading), heading
        )
        self.moving = Command(linear, angular)


@dataclass
class _Lidar:
    """The lidar; its scans arrive with a delay."""

    scene: Scene
    random: np.random.Generator
    phase: int
    angles: Floats = field(default_factory=lambda: -np.pi + np.arange(BEAMS) * 2 * np.pi / BEAMS)
    coming: list[Scan] = field(default_factory=list)
    count: int = 0

    def look(self, tick: int, around: Around) -> None:
        """Take a scan at this instant, if a scan is due."""
        if tick % SCAN_TICKS != self.phase or tick * TICK_S >= self.scene.silent_from_s:
            return
        found = ranges(around, self.angles) + self.random.normal(0.0, NOISE, BEAMS)
        is_lost = (found > RANGE_MAX) | (self.random.random(BEAMS) < self.scene.lost_share)
        found = np.where(is_lost, self.scene.no_return, np.maximum(found, 0.0))
        self.coming.append(Scan(round(tick * TICK_S * NS), found.astype(np.float32)))
        self.count += 1

    def arrived(self, tick: int, last: Scan | None) -> Scan | None:
        """The last scan that has arrived at this instant."""
        while self.coming and self.coming[0].stamp_ns <= (tick - DELAY_TICKS) * TICK_S * NS:
            last = self.coming.pop(0)
        return last


class _Drive:
    """One drive along a scene."""

    def __init__(self, scene: str, guard: Guard, seed: int) -> None:
        random = random_of(scene, seed)
        self.scene = SCENES[scene](random)
        self.guard = guard
        self.base = _Base(self.scene.start)
        self.lidar = _Lidar(self.scene, random, int(random.integers(SCAN_TICKS)))
        self.latest_s = self.first_reduced_s = math.nan
        self.least_gap_m = math.inf
        self.contact_speed = self.distance_m = self.falsely_slow_s = 0.0
        self.stops = self.false_stops = 0
        self.cpu_ns = 0
        self.command = self.wanted = Command(0.0, 0.0)
        self._is_stopped = False

    def run(self) -> None:
        """Drive to the end of the scene, or until the base drives into an obstacle."""
        scan: Scan | None = None
        odometry = Odometry(0, self.base.pose, self.base.moving)
        own_clock: Callable[[], int] | None = getattr(self.guard, "cpu_ns", None)
        began_ns = own_clock() if own_clock else 0
        for tick in range(round(self.scene.seconds / TICK_S)):
            around = self._around(tick)
            if self._touches(around):
                break
            self.lidar.look(tick, around)
            scan = self.lidar.arrived(tick, scan)
            now_ns = round(tick * TICK_S * NS)
            if tick % ODOMETRY_TICKS == 0:
                odometry = Odometry(now_ns, self.base.pose, self.base.moving)
            if tick % COMMAND_TICKS == 0:
                self._ask(scan, odometry, now_ns, gap_ahead(around, OUTLINE))
            self._move(tick, around)
        if own_clock:
            self.cpu_ns = own_clock() - began_ns

    def outcome(self, latest_s: float) -> Outcome:
        """The measurements."""
        pose = self.base.pose
        return Outcome(
            reaction_s=self.first_reduced_s - latest_s,
            blind_s=self.first_reduced_s - self.scene.silent_from_s,
            least_gap_m=self.least_gap_m,
            contact_speed=self.contact_speed,
            stops=self.stops,
            false_stops=self.false_stops,
            falsely_slow_s=self.falsely_slow_s,
            distance_m=self.distance_m,
            is_at_goal=pose.x > self.scene.goal_m - 0.02,
            cpu_ns_of_scan=self.cpu_ns / max(1, self.lidar.count),
        )

    def _around(self, tick: int) -> Around:
        pose = self.base.pose
        return seen_from(pose, self.scene.walls, self.scene.people_at(tick * TICK_S, pose))

    def _touches(self, around: Around) -> bool:
        """Say whether the base drives into an obstacle, which ends the drive. A person who walks
        into a base at rest is no collision.
        """
        found = gap(around, OUTLINE)
        self.least_gap_m = min(self.least_gap_m, found)
        if found == 0.0 and abs(self.base.moving.linear) > 0.01:
            self.contact_speed = abs(self.base.moving.linear)
        return self.contact_speed > 0.0

    def _ask(self, scan: Scan | None, odometry: Odometry, now_ns: int, free_m: float) -> None:
        self.wanted = planned(self.scene, odometry.pose)
        begin = time.thread_time_ns()
        self.command = self.guard(scan, odometry, self.wanted, now_ns)
        self.cpu_ns += time.thread_time_ns() - begin
        if scan is not None:
            self._judge(now_ns / NS, free_m)

    def _judge(self, now_s: float, free_m: float) -> None:
        """Judge if the command is reduced, and if this is right. Every guard may wait until the
        first scan.
        """
        wanted, given = self.wanted.linear, self.command.linear
        is_blind = now_s >= self.scene.silent_from_s + SILENCE_S
        is_right = (free_m < NEAR_M or is_blind) and not self.scene.is_passable
        is_reduced = given < wanted - 1e-3
        if is_reduced and is_right and math.isnan(self.first_reduced_s):
            self.first_reduced_s = now_s
        if is_reduced and not is_right:
            self.falsely_slow_s += COMMAND_TICKS * TICK_S
        is_stopped = is_reduced and given <= 0.1 * wanted
        if is_stopped and not self._is_stopped:
            self.stops += 1
            self.false_stops += not is_right
        self._is_stopped = is_stopped

    def _move(self, tick: int, around: Around) -> None:
        speed = self.base.moving.linear
        free_m = gap_ahead(around, OUTLINE)
        if math.isnan(self.latest_s) and speed > 0.0 and free_m <= speed**2 / (2 * BRAKING):
            self.latest_s = tick * TICK_S
        self.base.move(self.command)
        self.distance_m += abs(self.base.moving.linear) * TICK_S


def planned(scene: Scene, pose: Pose) -> Command:
    """The command of a planner that knows nothing about walls and people."""
    rest = scene.goal_m - pose.x
    if rest <= 0.005:
        return Command(0.0, 0.0)
    creep = 0.15 if scene.creep_m else 0.05
    speed = math.sqrt(creep**2 + 2 * 0.5 * max(0.0, rest - scene.creep_m))
    turning = -0.6 * pose.y - 1.5 * pose.heading
    return Command(min(SPEED, speed), max(-0.5, min(0.5, turning)))


def outcomes(contender: Contender, scene: str, runs: int) -> Iterator[Outcome]:
    """The outcomes of some runs of a scene."""
    return (run(scene, contender, seed) for seed in range(runs))
