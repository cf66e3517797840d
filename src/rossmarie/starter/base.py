"""Rules about the odometry, the inertia and the laser scans of a mobile base."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from rossmarie.starter.numbers import plain, rounded_down, rounded_up
from rossmarie.starter.robot import ProposedRules, RobotTopics, WatchedTopic

_ROOM = 1.2
"""The factor by which a limit exceeds the normal values of the recording."""
_UPRIGHT_DEG = 30
"""The largest initial tilt of an IMU in deg that is mounted level with the base."""
_LEAST_TILT_DEG, _MOST_TILT_DEG = 15, 30
_LATEST_SCAN_S = 0.5
_MOST_BEAMS = 4096
_FULL_TURN_DEG = 359


class Odometry:
    """The motion of a base."""

    word = "odometry"

    def __init__(self) -> None:
        self.fastest = 0.0

    def see(self, message: Any) -> None:
        """Process a message: its speed in m/s."""
        linear = message.twist.twist.linear
        speed = math.hypot(linear.x, linear.y, linear.z)
        if math.isfinite(speed):
            self.fastest = max(self.fastest, speed)

    def fields(self, name: str) -> Mapping[str, str]:
        """An input for the whole message."""
        return {name: ""}

    def limit(self) -> float:
        """A speed limit in m/s, above all speeds in the recording."""
        return rounded_up(max(self.fastest * _ROOM, 0.1))

    def proposals(self, watched: WatchedTopic, robot: RobotTopics) -> Iterator[ProposedRules]:
        """Proposals for a speed limit, and for stalled wheels, if another odometry measures the
        body.
        """
        rule = robot.rule(watched, "too_fast")
        yield ProposedRules(
            f"The fastest in the recording: {plain(self.fastest)} m/s.",
            f"rule {rule}: if norm({watched.name}.twist.twist.linear) > {plain(self.limit())} m/s"
            f" then {{ {robot.commands.slow}; }} clear for 1 sec;",
        )
        others = [each for each in robot.of_word(self.word) if each is not watched]
        filtered = [each for each in others if "filtered" in each.topic]
        if filtered and robot.commands.is_twist:
            commands, entry = robot.commands.topic, robot.commands.entry
            yield ProposedRules(
                "Wheels that turn while the body stands, and the other way round. The planner's"
                f" commands enter the filter as {entry}, which is not recorded: give"
                f" `replay` --topic-map {entry}={commands}.",
                f'import "rossmarie/base/stall.ross" with unfiltered = {entry},'
                f" odometry = {watched.topic}, localization = {filtered[0].topic},"
                f" cmd_vel = {commands} as {robot.rule(watched, 'drive')};",
            )


class Inertia:
    """The tilt and the turning of a base."""

    word = "imu"

    def __init__(self) -> None:
        self.tilt, self.turn = 0.0, 0.0
        self.first_tilt: float | None = None
        self.has_orientation = True

    def see(self, message: Any) -> None:
        """Process a message: its roll and pitch in deg, its turn rate in rad/s."""
        rate = message.angular_velocity
        turn = math.hypot(rate.x, rate.y, rate.z)
        if math.isfinite(turn):
            self.turn = max(self.turn, turn)
        q = message.orientation
        length = math.hypot(q.x, q.y, q.z, q.w)
        # REP 145: an IMU without an orientation reports -1.
        if message.orientation_covariance[0] == -1 or not 0.5 < length < 2:
            self.has_orientation = False
            return
        x, y, z, w = (each / length for each in (q.x, q.y, q.z, q.w))
        pitch = math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))
        roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
        tilt = math.degrees(max(abs(pitch), abs(roll)))
        self.tilt = max(self.tilt, tilt)
        self.first_tilt = tilt if self.first_tilt is None else self.first_tilt

    def fields(self, name: str) -> Mapping[str, str]:
        """An input for the whole message."""
        return {name: ""}

    def proposals(self, watched: WatchedTopic, robot: RobotTopics) -> Iterator[ProposedRules]:
        """Proposals for the tilt if the IMU measures it, else for the turn rate."""
        commands, name = robot.commands, watched.name
        first = self.first_tilt or 0.0
        if not self.has_orientation or first > _UPRIGHT_DEG:
            reason = f"begins tilted by {first:.0f} deg, so it may be mounted turned"
            if not self.has_orientation:
                reason = "tells no orientation"
            limit = rounded_up(max(self.turn * _ROOM, 0.5))
            yield ProposedRules(
                f"This IMU {reason}. The fastest turn in the recording: {plain(self.turn)} rad/s.",
                f"rule {robot.rule(watched, 'spinning')}: if norm({name}.angular_velocity) >"
                f" {plain(limit)} rad/s for 0.1 sec then {{ {commands.stop}; }} clear for 1 sec;",
            )
            return
        limit = min(max(_LEAST_TILT_DEG, math.ceil(self.tilt * _ROOM)), _MOST_TILT_DEG)
        yield ProposedRules(
            f"The steepest in the recording: {plain(self.tilt)} deg.",
            f"rule {robot.rule(watched, 'tilted')}:"
            f" if ({name}.orientation.pitch() not in [-{limit}, {limit}] deg"
            f" or {name}.orientation.roll() not in [-{limit}, {limit}] deg) for 0.3 sec"
            f" then {{ {commands.stop}; }} clear for 2 sec;",
        )
        if commands.is_twist:
            yield ProposedRules(
                "Slopes, bumps and falls: six rules of the library.",
                f'import "rossmarie/base/tilt.ross" with imu = {watched.topic},'
                f" cmd_vel = {commands.topic} as {robot.rule(watched, 'tilt')};",
            )


class ScannerDistances:
    """The distances that a laser scanner sees."""

    word = "scan"

    def __init__(self) -> None:
        self.sector: tuple[int, int] | None = None
        self.width = 0
        self.beams = 0
        self.nearest = math.inf

    def see(self, message: Any) -> None:
        """Process a message: its angles in deg, its nearest distance in m."""
        self.beams = max(self.beams, len(message.ranges))
        if self.sector is None:
            ends = sorted((math.degrees(message.angle_min), math.degrees(message.angle_max)))
            self.sector, self.width = _sector(*ends)
        seen = [each for each in message.ranges if message.range_min <= each < math.inf]
        self.nearest = min([self.nearest, *(each for each in seen if each > 0)])

    def fields(self, name: str) -> Mapping[str, str]:
        """An input for the whole message."""
        return {name: ""}

    def proposals(self, watched: WatchedTopic, robot: RobotTopics) -> Iterator[ProposedRules]:
        """Proposals for near objects, in a visible sector, and for a blind scanner."""
        if self.sector is None:
            return
        (right, left), commands = self.sector, robot.commands
        limit = rounded_down(min(max(self.nearest * 0.8, 0.1), 0.5))
        nearest = "The recording has nothing in reach."
        if math.isfinite(self.nearest):
            nearest = f"The nearest in the recording: {plain(self.nearest)} m."
        yield ProposedRules(
            f"{nearest} The sector is by the angles of the scanner; 0 deg is where it looks.",
            f"rule {robot.rule(watched, 'near')}:"
            f" if min({watched.name}.ranges[{right} deg .. {left} deg]) < {plain(limit)} m"
            f" then {{ {commands.stop}; }} clear for 0.5 sec;",
        )
        if commands.is_twist:
            yield from self._imports(watched, robot, right, left)

    def _imports(
        self, watched: WatchedTopic, robot: RobotTopics, right: int, left: int
    ) -> Iterator[ProposedRules]:
        odometries = robot.of_word(Odometry.word)
        cmd_vel = robot.commands.topic
        if odometries and isinstance(odometries[0].kind, Odometry):
            fastest = odometries[0].kind.limit()
            yield ProposedRules(
                "Keep the stopping distance. Set `braking`, `acceleration`, `latency` and `margin`"
                " to those of your robot.",
                f'import "rossmarie/base/separation.ross" with scan = {watched.topic},'
                f" odometry = {odometries[0].topic}, cmd_vel = {cmd_vel}, right = {right} deg,"
                f" left = {left} deg, fastest = {plain(fastest)} m/s,"
                f" silence = {plain(watched.timeout)} sec"
                f" as {robot.rule(watched, 'separation')};",
            )
        if self.beams <= _MOST_BEAMS and watched.timeout < _LATEST_SCAN_S:
            yield ProposedRules(
                "A scanner that is covered, stuck or dirty.",
                f'import "rossmarie/scan/health.ross" with scan = {watched.topic},'
                f" cmd_vel = {cmd_vel}, right = {right} deg, left = {left} deg,"
                f" late = {plain(watched.timeout)} sec, width = {self.width} deg"
                f" as {robot.rule(watched, 'lens')};",
            )


def _sector(low: float, high: float) -> tuple[tuple[int, int] | None, int]:
    """The visible part in deg ahead of a scanner, and its whole visible angle."""
    if not (math.isfinite(low) and math.isfinite(high)) or high - low > 2 * 360:
        return None, 0
    if high - low >= _FULL_TURN_DEG:
        return (-90, 90), math.floor(high - low)
    right, left = math.ceil(low), math.floor(high)
    if right < 0 < left:
        right, left = max(right, -90), min(left, 90)
    left = min(left, right + 180)
    return ((right, left) if right < left else None), max(0, math.floor(high - low))
