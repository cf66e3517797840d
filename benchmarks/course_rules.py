"""Rules of ROSSMARie as guards on the course. A rules file acts like its generated node."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from course import Command, Contender, Odometry, Scan
from course_scenes import BRAKING, HALF_LENGTH, HALF_WIDTH, SPEED
from nav2_settings import LATENCY_S, SIDE_M, STOP_M

from heron import messages
from heron.guard import InProcessGuard, unfiltered
from heron.messages import Message
from heron.topics import COMMAND, ODOMETRY, SCAN, InProcess, Topic
from rossmarie.driver import compile_file
from rossmarie.ir import Machine


@dataclass(frozen=True)
class Rules:
    """A rules file for the base of the course, with the topics /scan, /odom and /cmd_vel."""

    name: str
    text: str

    def machine(self, folder: Path) -> Machine:
        """These rules, compiled in a folder."""
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / "course.ross"
        path.write_text(self.text, encoding="utf-8")
        return compile_file(path).machine

    def contender(self, folder: Path) -> Contender:
        """These rules as a guard on the course. `folder` holds the rules file."""
        machine = self.machine(folder)

        @contextmanager
        def run() -> Iterator[_OnGuard]:
            yield _OnGuard(machine)

        return Contender(self.name, run)


RANGES = Rules(
    "rules: min(ranges)",
    f"""
action stop {{ block /cmd_vel : geometry_msgs/Twist; }}
action slow {{
    limit /cmd_vel : geometry_msgs/Twist {{ linear.x in [-{SPEED / 2}, {SPEED / 2}] m/s; }};
}}
input ranges = topic /scan : sensor_msgs/LaserScan .ranges timeout 0.3 sec
rule near: if min(ranges) < {HALF_LENGTH + STOP_M:.2f} m then {{ stop; }};
rule close: if min(ranges) < {HALF_LENGTH + 2 * STOP_M:.2f} m then {{ slow; }};
""",
)
"""Distances from the lidar in all directions. Ahead, the distances equal the zones of Nav2."""

GUARDS = Path(__file__).parent / "guards"


def _of_file(name: str, file: str, **numbers: str) -> Rules:
    """The rules of a file, with the outline of the base and the numbers of the settings of Nav2."""
    outline = {"front": f"{HALF_LENGTH} m", "side": f"{HALF_WIDTH} m"}
    values = ", ".join(f"{key} = {value}" for key, value in {**outline, **numbers}.items())
    return Rules(f"rules: {name}", f'import "{GUARDS / file}" with {values};\n')


ZONES = _of_file("zones", "zones.ross", stop=f"{STOP_M} m", aside=f"{SIDE_M} m")
APPROACH = _of_file("approach", "approach.ross")
STOPPING = _of_file(
    "stopping",
    "stopping.ross",
    aside=f"{SIDE_M} m",
    braking=f"{BRAKING} m/s^2",
    latency=f"{LATENCY_S} sec",
)

ALL = (ZONES, APPROACH, STOPPING, RANGES)
"""The first two rules files mean the same as the settings of Nav2; the last has no geometry."""


class _OnGuard:
    """The rules in one run. The CPU time excludes the construction of messages."""

    def __init__(self, machine: Machine) -> None:
        carrier = InProcess()
        self._now_ns = self._cpu_ns = 0
        self._guard = InProcessGuard(machine, carrier, lambda: self._now_ns)
        self._scan, self._odometry = carrier.publisher(SCAN), carrier.publisher(ODOMETRY)
        self._command = carrier.publisher(Topic(unfiltered(COMMAND.name), COMMAND.type))
        carrier.subscribe(COMMAND, self._hear)
        self._given = Command(0.0, 0.0)
        self._last: Scan | None = None

    def cpu_ns(self) -> int:
        """The CPU time of the guard so far (ns)."""
        return self._cpu_ns

    def __call__(
        self, scan: Scan | None, odometry: Odometry, command: Command, at_ns: int
    ) -> Command:
        """The command after the rules."""
        self._now_ns = at_ns
        heard = [(self._odometry, _odometry(odometry))]
        if scan is not None and scan is not self._last:
            heard.append((self._scan, _scan(scan)))
            self._last = scan
        heard.append((self._command, messages.twist(command.linear, command.angular)))
        self._take_in(heard)
        return self._given

    def _take_in(self, heard: list[tuple[Callable[[Message], None], Message]]) -> None:
        begin = time.thread_time_ns()
        self._guard.tick(self._now_ns)
        for publish, message in heard:
            publish(message)
        self._cpu_ns += time.thread_time_ns() - begin

    def _hear(self, message: Message) -> None:
        self._given = Command(message.linear.x, message.angular.z)


def _scan(scan: Scan) -> Message:
    last = scan.angle_min + (len(scan.ranges) - 1) * scan.angle_increment
    angles = (scan.angle_min, last, scan.angle_increment)
    reach = (scan.range_min, scan.range_max)
    message = messages.laser_scan(scan.stamp_ns, angles, reach, scan.ranges)
    message.header.frame_id = "base_link"
    return message


def _odometry(odometry: Odometry) -> Message:
    pose, moving = odometry.pose, odometry.moving
    velocity = messages.twist(moving.linear, moving.angular)
    return messages.odometry(odometry.stamp_ns, pose.x, pose.y, pose.heading, velocity)
