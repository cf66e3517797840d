"""The arm of the task on topics: its readings and commands as the messages in the rules."""

from __future__ import annotations

from typing import Any

import gymnasium

from heron import messages
from heron.learning.environment import PegInHole
from heron.learning.insertion import FIELDS
from heron.messages import type_name
from heron.topics import WRENCH, Carrier, Topic

PLACE = Topic("/arm/pose", type_name(messages.Point))
PERSON = Topic("/person/distance", type_name(messages.Float64))
VELOCITY = Topic("/arm/velocity", type_name(messages.Twist))
PUSH = Topic("/arm/push", type_name(messages.Wrench))


class TopicReadings:
    """Readings as messages on the topics that the rules hear."""

    def __init__(self, carrier: Carrier) -> None:
        self._place = carrier.publisher(PLACE)
        self._force = carrier.publisher(WRENCH)
        self._person = carrier.publisher(PERSON)

    def publish(self, observation: Any, at_ns: int) -> None:
        """Publish an observation, in the order in which the rules name the topics."""
        read = dict(zip(FIELDS, observation.tolist(), strict=True))
        self._place(messages.Point(*(read[f"place.{axis}"] for axis in "xyz")))
        x, y, z = (read[f"force.{axis}"] for axis in "xyz")
        self._force(messages.wrench(at_ns, (x, y, z)))
        self._person(messages.Float64(read["person"]))


class OnTopics(gymnasium.Wrapper[Any, Any, Any, Any]):
    """Publishes each reading of an environment of this package, and each command that is executed.

    It stands inside of the guard: `guarded(OnTopics(env, carrier), arm)`.
    """

    def __init__(self, env: gymnasium.Env[Any, Any], carrier: Carrier) -> None:
        super().__init__(env)
        task = env.unwrapped
        assert isinstance(task, PegInHole)
        self._task = task
        task.on_reading.append(self._tell)
        self._readings = TopicReadings(carrier)
        self._velocity = carrier.publisher(VELOCITY)
        self._push = carrier.publisher(PUSH)

    def now_ns(self) -> int:
        """The time in the episode: the clock of the messages."""
        return self._task.insertion.elapsed_ns

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begin an episode."""
        observation, info = super().reset(seed=seed, options=options)
        self._tell(observation)
        return observation, info

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """Take a step."""
        command, none = self._task.command(action), messages.Vector3(0.0, 0.0, 0.0)
        self._velocity(messages.Twist(messages.Vector3(*command.velocity), none))
        self._push(messages.Wrench(messages.Vector3(0.0, 0.0, command.push), none))
        stepped = super().step(action)
        self._tell(stepped[0])
        return stepped

    def _tell(self, observation: Any) -> None:
        self._readings.publish(observation, self.now_ns())
