"""The arm that holds the peg, as a ROS 1 node that publishes its readings and executes commands."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence

from gymnasium.utils import seeding

from heron.learning.arm import READING_NS, ArmCommand
from heron.learning.environment import GREATEST
from heron.learning.insertion import Insertion, InsertionOutcome, TaskParameters
from heron.learning.on_topics import PUSH, VELOCITY, TopicReadings
from heron.messages import Message
from heron.operation.pace import Pace
from heron.ros1 import Ros1Error
from heron.ros1.carrier import Ros1Carrier
from heron.ros1.node import Ros1Node
from heron.scene.insertion import InsertionParameters
from heron.topics import Topic

LAPSES_NS = 100_000_000
"""A command counts for so long. The hand stands still without a velocity, and does not push without
a push.
"""
_PATIENCE_S = 30.0
_GUARD = "start the node that is built from insertion.ross"


class LiveArm:
    """An episode in real time: 125 readings in a second, and after each one the latest commands."""

    def __init__(self, node: Ros1Node, seed: int) -> None:
        """The arm stands where the episode of a seed begins, as in the environment."""
        self._node = node
        self._insertion = _ByReadings(TaskParameters(InsertionParameters()))
        self._insertion.begin(seeding.np_random(seed)[0])
        self._readings = TopicReadings(Ros1Carrier(node, lambda: None))
        self._velocity = _Latest(GREATEST[:3].tolist())
        self._push = _Latest(GREATEST[3:].tolist())
        node.subscribe(VELOCITY.name, VELOCITY.type, self._hear_velocity)
        node.subscribe(PUSH.name, PUSH.type, self._hear_push)

    def run(self) -> InsertionOutcome:
        """Wait until a command moves the arm. Then run the episode until the peg is inserted or the
        time is over. Raises `Ros1Error` if no command arrives within 30 s, or if the commanding
        node has gone.
        """
        self._node.wait_while(self._lacking)
        insertion, pace = self._insertion, Pace(READING_NS)
        end = time.monotonic() + _PATIENCE_S
        while not (insertion.outcome.inserted or insertion.is_over):
            self._node.connect()
            self._node.deliver()
            command = self._command()
            if insertion.elapsed_ns > 0 or command != _STANDING:
                insertion.follow(command)
            elif time.monotonic() > end:
                raise Ros1Error(
                    f"no command has moved the arm within {_PATIENCE_S:.0f} s: start `heron policy`"
                )
            self._readings.publish(insertion.observation(), time.time_ns())
            pace.wait()
        return insertion.outcome

    def _lacking(self) -> str | None:
        silent = [topic for topic in (VELOCITY, PUSH) if not self._node.hears(topic.name)]
        return f"no node publishes {_names(silent)}: {_GUARD}" if silent else None

    def _command(self) -> ArmCommand:
        x, y, z = self._velocity.now()
        (push,) = self._push.now()
        return ArmCommand((x, y, z), min(push, 0.0))

    def _hear_velocity(self, message: Message) -> None:
        linear = message.linear
        self._velocity.put((linear.x, linear.y, linear.z))

    def _hear_push(self, message: Message) -> None:
        self._push.put((message.force.z,))


_STANDING = ArmCommand((0.0, 0.0, 0.0), 0.0)


class _ByReadings(Insertion):
    """The task, whose commands may change after each reading."""

    def follow(self, command: ArmCommand) -> None:
        """Execute a command until the next reading."""
        self.arm.follow(command)
        self.elapsed_ns += READING_NS
        self._note()


class _Latest:
    """The latest numbers of a command, which lapse; as zeros if there are none."""

    def __init__(self, greatest: Sequence[float]) -> None:
        self._none = (0.0,) * len(greatest)
        self._greatest = greatest
        self._values: Sequence[float] = self._none
        self._until_ns = 0

    def put(self, values: Sequence[float]) -> None:
        """Obey these from now on, each as far as the arm can; none of them if one is no number."""
        is_command = all(map(math.isfinite, values))
        self._values = values if is_command else self._none
        self._until_ns = time.monotonic_ns() + LAPSES_NS

    def now(self) -> Sequence[float]:
        """The numbers that count now."""
        if time.monotonic_ns() > self._until_ns:
            return self._none
        bounded = zip(self._values, self._greatest, strict=True)
        return [min(max(value, -most), most) for value, most in bounded]


def _names(topics: Sequence[Topic]) -> str:
    return " and ".join(topic.name for topic in topics)
