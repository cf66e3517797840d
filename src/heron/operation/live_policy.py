"""A policy as a ROS 1 node that subscribes to the readings of an arm, and commands it through the
guard node. It only uses the topics of the rules.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

import numpy as np

from heron import messages
from heron.guard import unfiltered
from heron.learning.arm import READING_NS
from heron.learning.environment import MOVES
from heron.learning.insertion import LONGEST_S, READINGS
from heron.learning.learned import Act
from heron.learning.on_topics import PERSON, PLACE, PUSH, VELOCITY
from heron.messages import Message
from heron.ros1 import Ros1Error
from heron.ros1.node import Ros1Node
from heron.topics import WRENCH, Topic

WANTED_VELOCITY = Topic(unfiltered(VELOCITY.name), VELOCITY.type)
WANTED_PUSH = Topic(unfiltered(PUSH.name), PUSH.type)
"""The topics in front of the node on guard."""
_HEARD = (PLACE, WRENCH, PERSON)
_READING_S = READING_NS * 1e-9
_LOOK_S = 0.001


class LivePolicy:
    """A policy for one episode. It acts on each fifth reading, as it did when it learned; if the
    readings pause, so does it.
    """

    def __init__(self, node: Ros1Node, act: Act) -> None:
        self._node, self._act = node, act
        self._places: list[Sequence[float]] = []
        self._force: Sequence[float] = ()
        self._person = np.inf
        self._count = 0
        for topic, hear in zip(
            _HEARD, (self._hear_place, self._hear_force, self._hear_person), strict=True
        ):
            node.subscribe(topic.name, topic.type, hear)
        node.advertise(WANTED_VELOCITY)
        node.advertise(WANTED_PUSH)

    def run(self) -> float:
        """Act until the time of an episode is over, or the arm is gone; gives the time (s) of its
        readings. Raises `Ros1Error` if within 30 s there is no arm, or no node on guard.
        """
        self._node.wait_while(self._lacking)
        due = 1
        with suppress(Ros1Error):  # the episode of the arm is over
            self._node.deliver()
            self._count = 0  # until now the arm has stood still
            while self._count * _READING_S < LONGEST_S:
                self._node.deliver()
                if self._count < due or not self._force or len(self._places) < 2:
                    time.sleep(_LOOK_S)
                    continue
                self._command(self._act(self._observation()))
                due += READINGS * (1 + (self._count - due) // READINGS)
        return self._count * _READING_S

    def _lacking(self) -> str | None:
        silent = [topic.name for topic in _HEARD if not self._node.hears(topic.name)]
        if silent:
            return f"no node publishes {', '.join(silent)}: start `heron run insertion --ros1`"
        deaf = [
            topic.name
            for topic in (WANTED_VELOCITY, WANTED_PUSH)
            if not self._node.has_listeners(topic.name)
        ]
        guard = "start the node that is built from insertion.ross"
        return f"no node subscribes to {', '.join(deaf)}: {guard}" if deaf else None

    def _observation(self) -> Any:
        """The numbers of an observation. Velocities follow from the last two places."""
        before, place = map(np.array, self._places)
        left = LONGEST_S - self._count * _READING_S
        return np.array([*place, *(place - before) / _READING_S, *self._force, self._person, left])

    def _command(self, action: Any) -> None:
        chosen = MOVES[action] if isinstance(action, int) else action
        x, y, z, push = map(float, chosen)
        none = messages.Vector3(0.0, 0.0, 0.0)
        velocity = messages.Twist(messages.Vector3(x, y, z), none)
        self._node.publish(WANTED_VELOCITY, velocity)
        pushing = messages.Wrench(messages.Vector3(0.0, 0.0, min(push, 0.0)), none)
        self._node.publish(WANTED_PUSH, pushing)

    def _hear_place(self, place: Message) -> None:
        self._places = [*self._places[-1:], (place.x, place.y, place.z)]

    def _hear_force(self, reported: Message) -> None:
        force = reported.wrench.force
        self._force = (force.x, force.y, force.z)

    def _hear_person(self, distance: Message) -> None:
        """The last topic of a reading."""
        self._person = distance.data
        self._count += 1
