"""The channels of a machine: topics, and transforms between frames, which share a topic."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Edge:
    """The transform from the frame `child` to the frame `parent` in messages on a `topic`. Each
    message has any number of transforms.
    """

    topic: str
    parent: str
    child: str

    def __str__(self) -> str:
        return f"{self.topic} ({self.child} in {self.parent})"


TRANSFORMS = "tf2_msgs/TFMessage"
"""The type of messages with transforms."""


def bare_frame(name: str) -> str:
    """The name of a frame in a transform, without the leading slash that older programs write; tf2
    omits it.
    """
    return name.removeprefix("/")


@dataclass(frozen=True)
class Channel:
    """A topic: one message on the topic is one update of all its inputs.

    With an `edge`, the channel is a transform: `topic` is only a name, and `message_type` is the
    type of the transform. A message on the topic of the edge updates this channel if it contains
    the transform.

    `gaps_ns` are the least and the greatest time between two messages; None if they are not
    declared. They come from a system model, and no monitor relies on them.
    """

    topic: str
    message_type: str
    gaps_ns: tuple[int, int] | None = None
    edge: Edge | None = None

    @property
    def source(self) -> str:
        """The topic of the channel's messages."""
        return self.topic if self.edge is None else self.edge.topic

    @property
    def source_type(self) -> str:
        """The type of the messages on the source topic."""
        return self.message_type if self.edge is None else TRANSFORMS
