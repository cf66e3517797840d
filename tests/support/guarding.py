"""A guard over rules in a text, with a clock that tests turn, and what it publishes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from heron import messages
from heron.guard import InProcessGuard
from heron.messages import Message
from heron.topics import BOOST, COMMAND, ODOMETRY, InProcess, Topic
from rossmarie.driver import compile_file

UNFILTERED = Topic("/unfil_cmd_vel", COMMAND.type)


@dataclass
class Guarded:
    """A guard on a carrier; `sent` and `boosts` are what came out so far."""

    carrier: InProcess = field(default_factory=InProcess)
    now_ns: int = 0
    sent: list[tuple[int, float]] = field(default_factory=list)
    boosts: list[int] = field(default_factory=list)

    def start(self, rules: Path) -> InProcessGuard:
        """The guard of a rules file."""
        self.carrier.subscribe(COMMAND, lambda one: self.sent.append((self.now_ns, one.linear.x)))
        self.carrier.subscribe(BOOST, lambda _: self.boosts.append(self.now_ns))
        return InProcessGuard(compile_file(rules).machine, self.carrier, lambda: self.now_ns)

    def publish(self, topic: Topic, message: Message) -> None:
        """Send a message, now."""
        self.carrier.publisher(topic)(message)

    def speed(self, value: float) -> None:
        """Wheel odometry says how fast the base is."""
        velocity = messages.twist(value, 0.0)
        self.publish(ODOMETRY, messages.odometry(self.now_ns, 0.0, 0.0, 0.0, velocity))

    def command(self, value: float) -> None:
        """A program commands a speed."""
        self.publish(UNFILTERED, messages.twist(value, 0.0))

    def pass_time(self, guard: InProcessGuard, until_ns: int, each: Callable[[], None]) -> None:
        """Time passes; every tenth of a second something happens."""
        while self.now_ns < until_ns:
            self.now_ns += guard.period_ns
            if self.now_ns % 100_000_000 == 0:
                each()
            guard.tick(self.now_ns)
