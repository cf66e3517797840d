"""Connections between the robot, its programs and its guard: topics, action servers, parameters.

A `Carrier` delivers messages by the name and the type of their topic. Senders and receivers do not
know each other. `InProcess` delivers each message at once.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Protocol

from heron import messages
from heron.goals import Server
from heron.messages import Message, type_name
from rossmarie.ir import TRANSFORMS

Publish = Callable[[Message], None]


@dataclass(frozen=True)
class Topic:
    """A topic: its name and the type of its messages, such as `sensor_msgs/Imu`."""

    name: str
    type: str


IMU = Topic("/imu/data", type_name(messages.Imu))
ODOMETRY = Topic("/odom", type_name(messages.Odometry))
POSE = Topic("/amcl_pose", type_name(messages.PoseWithCovarianceStamped))
COMMAND = Topic("/cmd_vel", type_name(messages.Twist))
JOYSTICK = Topic("/joy_vel", type_name(messages.Twist))
BOOST = Topic("/drive/boost", type_name(messages.Bool))
WRENCH = Topic("/wrench", type_name(messages.WrenchStamped))
FRAMES = Topic("/tf", TRANSFORMS)
SCAN = Topic("/scan", type_name(messages.LaserScan))
JOINT_STATES = Topic("/joint_states", type_name(messages.JointState))
GRAVITY_FREE = Topic("/arm/gravity_free", type_name(messages.Bool))
ARM_STOP = Topic("/arm/stop", type_name(messages.Bool))
SKILL_CONTEXT = Topic("/skill_context", "skill_context_msgs/SkillContext")
REPLAN = Topic("/navigation/replan", type_name(messages.Bool))


class TopicTypeError(TypeError):
    """A topic is used with messages of two types."""


@dataclass(frozen=True)
class NodeParameter:
    """A number that can be set while a node runs."""

    get: Callable[[], float]
    set: Callable[[float], None]


class Carrier(Protocol):
    """The carrier of messages."""

    def publisher(self, topic: Topic) -> Publish:
        """A function that sends a message on a topic."""

    def subscribe(self, topic: Topic, receive: Callable[[Message], None]) -> None:
        """`receive` gets each message on a topic."""

    def serve(self, name: str, server: Server) -> None:
        """Offer an action server."""

    def server(self, name: str) -> Server:
        """An action server. Raises `KeyError` if it is not there."""

    def declare(self, name: str, parameter: NodeParameter) -> None:
        """Offer a parameter. Its name begins with the name of its node."""

    def parameter(self, name: str) -> NodeParameter:
        """A parameter. Raises `KeyError` if it is not there."""


class InProcess:
    """Hands each message over at once, to listeners in the order in which they came."""

    def __init__(self) -> None:
        self._types: dict[str, str] = {}
        self._servers: dict[str, Server] = {}
        self._parameters: dict[str, NodeParameter] = {}
        self._listeners: defaultdict[str, list[Callable[[Message], None]]] = defaultdict(list)

    @property
    def topics(self) -> tuple[Topic, ...]:
        """All topics with a publisher or a subscriber."""
        return tuple(Topic(name, kind) for name, kind in self._types.items())

    def publisher(self, topic: Topic) -> Publish:
        """A function that sends a message on a topic."""
        self._enter(topic)
        listeners = self._listeners[topic.name]

        def publish(message: Message) -> None:
            for receive in listeners:
                receive(message)

        return publish

    def subscribe(self, topic: Topic, receive: Callable[[Message], None]) -> None:
        """`receive` gets each message on a topic."""
        self._enter(topic)
        self._listeners[topic.name].append(receive)

    def serve(self, name: str, server: Server) -> None:
        """Offer an action server."""
        self._servers[name] = server

    def server(self, name: str) -> Server:
        """An action server. Raises `KeyError` if it is not there."""
        return self._servers[name]

    def declare(self, name: str, parameter: NodeParameter) -> None:
        """Offer a parameter."""
        self._parameters[name] = parameter

    def parameter(self, name: str) -> NodeParameter:
        """A parameter. Raises `KeyError` if it is not there."""
        return self._parameters[name]

    def _enter(self, topic: Topic) -> None:
        known = self._types.setdefault(topic.name, topic.type)
        if known != topic.type:
            raise TopicTypeError(f"{topic.name} carries {known}, not {topic.type}")


@dataclass(frozen=True)
class Remapped:
    """A carrier as seen by a node that was started with other names for its topics."""

    carrier: Carrier
    names: Mapping[str, str]

    def publisher(self, topic: Topic) -> Publish:
        """A function that sends a message on a topic."""
        return self.carrier.publisher(self._renamed(topic))

    def subscribe(self, topic: Topic, receive: Callable[[Message], None]) -> None:
        """`receive` gets each message on a topic."""
        self.carrier.subscribe(self._renamed(topic), receive)

    def serve(self, name: str, server: Server) -> None:
        """Offer an action server."""
        self.carrier.serve(self.names.get(name, name), server)

    def server(self, name: str) -> Server:
        """An action server. Raises `KeyError` if it is not there."""
        return self.carrier.server(self.names.get(name, name))

    def declare(self, name: str, parameter: NodeParameter) -> None:
        """Offer a parameter."""
        self.carrier.declare(name, parameter)

    def parameter(self, name: str) -> NodeParameter:
        """A parameter. Raises `KeyError` if it is not there."""
        return self.carrier.parameter(name)

    def _renamed(self, topic: Topic) -> Topic:
        return Topic(self.names.get(topic.name, topic.name), topic.type)
