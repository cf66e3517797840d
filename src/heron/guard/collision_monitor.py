"""A guard without rules, as on many ROS 2 robots: zones of a range scan slow the robot down or stop
it, a speed limit holds everywhere, and the robot continues when the zones are free.

It behaves like Nav2's `nav2_collision_monitor` with zones of the kinds `stop` and `slowdown`
(docs.nav2.org, "Using Collision Monitor"), with a speed limit as in Nav2's `velocity_smoother`. The
drive replaces `twist_mux`: the joystick has precedence over programs, and missing commands count as
a stop.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from heron import messages
from heron.guard.model import Occurrence, unfiltered
from heron.guard.zones import ScannerCircle, ScannerRectangle, SpeedZone, ZoneWatch
from heron.messages import Message
from heron.robot.arm_controller import SPEED_SCALE
from heron.topics import COMMAND, Carrier, Topic
from rossmarie.ir import TaskCommandKind

BASE_SPEED = 0.25
"""m/s; up to this speed makers of such bases allow bumps at all (Neobotix MP-500, data sheet: 15 mm
at 0.25 m/s at most)."""
BASE_ZONES = (
    SpeedZone("stop_zone", ScannerRectangle(0.0, 0.75, 0.35), 0.0),
    SpeedZone("slow_zone", ScannerRectangle(0.0, 1.25, 0.5), 0.3),
)
"""The base reaches 0.45 m ahead. The stop zone extends 0.3 m farther, and the slow zone 0.8 m
farther. The speed ratio comes from the tutorial.
"""
ARM_ZONES = (
    SpeedZone("stop_when_close", ScannerCircle(2.4), 0.0),
    SpeedZone("slow_when_entered", ScannerCircle(3.8), 0.3),
)
"""The stop zone is the close distance of the rules, rounded up. The slow zone is the room."""


class _CollisionMonitor:
    """The part that both have in common; `is_restricting` and the effect are their own."""

    period_ns = 20_000_000
    latched: tuple[str, ...] = ()
    """No zone waits for an operator."""

    def __init__(self, carrier: Carrier, zones: Sequence[SpeedZone]) -> None:
        self._watch = ZoneWatch(carrier, zones)
        self._in_force: dict[str, float] = {}
        self._has_begun = False
        self.occurrences: list[Occurrence] = []
        self.reported: list[tuple[int, str]] = []

    @property
    def active(self) -> tuple[str, ...]:
        """The active zones, after the first scan."""
        return tuple(self._in_force) if self._has_begun else ()

    @property
    def is_acting(self) -> bool:
        """True while any zone is in force; a robot that waits for its first scan does not move."""
        return bool(self.active)

    @property
    def ratio(self) -> float:
        """The share of the speed that the strictest zone leaves."""
        return min(self._in_force.values(), default=1.0)

    def reset(self) -> None:
        """There is nothing to reset."""

    def tick(self, now_ns: int) -> None:
        """Look at the zones."""
        before = self._in_force if self._has_begun else {}
        self._has_begun = self._watch.has_begun
        self._in_force = self._watch.in_force(now_ns)
        if not self._has_begun:
            return
        for name in self._in_force:
            if name not in before:
                self._tell(now_ns, name, TaskCommandKind.START)
        for name in before:
            if name not in self._in_force:
                self._tell(now_ns, name, TaskCommandKind.STOP)

    def _tell(self, now_ns: int, name: str, kind: TaskCommandKind) -> None:
        what = "activated" if kind is TaskCommandKind.START else "cleared"
        self.reported.append((now_ns, f"{name} {what}"))
        self.occurrences.append(Occurrence(now_ns, name, "scale_speed", kind))


class BaseCollisionMonitor(_CollisionMonitor):
    """Between the programs that drive the base and its drive."""

    def __init__(self, carrier: Carrier, clock: Callable[[], int]) -> None:
        super().__init__(carrier, BASE_ZONES)
        self._clock = clock
        self._send = carrier.publisher(COMMAND)
        self._command: Message | None = None
        self.is_restricting = False
        """True if the last sent command differs from the command of the program."""
        carrier.subscribe(Topic(unfiltered(COMMAND.name), COMMAND.type), self._receive)

    def tick(self, now_ns: int) -> None:
        """Look at the zones; a stop does not wait for the next command."""
        before = self.ratio
        super().tick(now_ns)
        if self.ratio < before and self._command is not None:
            self._pass(self._command)

    def _receive(self, command: Message) -> None:
        self._command = command
        self._pass(command)

    def _pass(self, command: Message) -> None:
        """Both speeds by the same share, so that the robot stays on its path."""
        linear, angular = command.linear.x, command.angular.z
        share = self.ratio * min(1.0, BASE_SPEED / max(abs(linear), BASE_SPEED))
        self._send(messages.twist(share * linear, share * angular))
        self.is_restricting = share < 1.0 and (linear, angular) != (0.0, 0.0)


class ArmCollisionMonitor(_CollisionMonitor):
    """Scales the speed of the arm, as the fields of a safety scanner switch a robot to its reduced
    mode and stop it.
    """

    def __init__(self, carrier: Carrier) -> None:
        super().__init__(carrier, ARM_ZONES)
        self._scale = carrier.parameter(SPEED_SCALE)

    @property
    def is_restricting(self) -> bool:
        """True while the arm is slower than it would be."""
        return self.is_acting

    def tick(self, now_ns: int) -> None:
        """Look at the zones."""
        super().tick(now_ns)
        if self._scale.get() != self.ratio:
            self._scale.set(self.ratio)
