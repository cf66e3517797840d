"""A carrier of messages on both sides of a topic: in this process and in ROS."""

from __future__ import annotations

from collections.abc import Callable

from heron.messages import Message
from heron.ros1.node import Ros1Node
from heron.topics import InProcess, Publish, Topic


class Ros1Carrier(InProcess):
    """`announce` is called before a message goes out into ROS."""

    def __init__(self, node: Ros1Node, announce: Callable[[], None]) -> None:
        super().__init__()
        self._node = node
        self._announce = announce
        self._subscribed: set[str] = set()

    def publisher(self, topic: Topic) -> Publish:
        """A function that sends a message on a topic."""
        hand_over = super().publisher(topic)
        self._node.advertise(topic)

        def publish(message: Message) -> None:
            self._announce()
            self._node.publish(topic, message)
            hand_over(message)

        return publish

    def subscribe(self, topic: Topic, receive: Callable[[Message], None]) -> None:
        """`receive` gets each message on a topic."""
        super().subscribe(topic, receive)
        if topic.name not in self._subscribed:
            self._subscribed.add(topic.name)
            self._node.subscribe(topic.name, topic.type, super().publisher(topic))
