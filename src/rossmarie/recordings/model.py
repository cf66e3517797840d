"""The interface of every recording, whatever its file format.

Instants are integers in nanoseconds: the stamps at which messages were received (ROS: log time),
not the stamps in headers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar, NamedTuple, Protocol

from dslkit.diagnostics import Collector, Diagnostic
from rossmarie.ir import Batch, ChannelValues, Machine


@dataclass(frozen=True)
class RecordedTopic:
    """A recorded topic; `message_type` is, for example, `sensor_msgs/Imu`, or None if the file has
    no types.

    `count` is the number of its messages.
    """

    name: str
    message_type: str | None
    count: int


@dataclass(frozen=True)
class Transforms:
    """The recorded transforms of one frame in another frame; `longest_ns` is the longest time
    between two of them in ns.
    """

    parent: str
    child: str
    is_static: bool
    count: int
    longest_ns: int


@dataclass(frozen=True)
class FramesFound:
    """The frames of a recording: all transforms, and the frame of each topic whose headers always
    contain the same frame.
    """

    transforms: Sequence[Transforms] = ()
    headers: Mapping[str, str] = field(default_factory=dict)


Observe = Callable[[Any], None]
"""A function that receives a message, with the message's fields as attributes."""


@dataclass(frozen=True)
class Rhythm:
    """The arrivals of messages on one topic: the median time between successive messages, the
    longest time, and the share of times that are longer than `Rhythm.OUTLIER` medians.
    """

    OUTLIER: ClassVar[int] = 10

    count: int
    median_ns: int
    longest_ns: int
    outliers: float


@dataclass(frozen=True)
class Survey:
    """The rhythm of each observed topic, and the frames. `end_ns` is the stamp of the last message
    that was read. `is_whole` is True if the time limit left nothing unread.
    """

    rhythms: Mapping[str, Rhythm] = field(default_factory=dict)
    frames: FramesFound = FramesFound()
    end_ns: int = 0
    is_whole: bool = True


class Update(NamedTuple):
    """The values that arrive at one instant, by channel: one message, or one row of a CSV file."""

    at_ns: int
    channels: Mapping[int, ChannelValues]


class Recording(Protocol):
    """An open recording. Call `close`, or use the recording in a `with` statement."""

    @property
    def path(self) -> Path:
        """The path of the recording."""

    @property
    def topics(self) -> Mapping[str, RecordedTopic]:
        """The topics that were recorded, by name."""

    @property
    def start_ns(self) -> int:
        """The instant of the first message, or of the first row of a CSV file."""

    @property
    def end_ns(self) -> int:
        """The instant of the last message or row. It is before `start_ns` if the clock of a CSV
        file goes back.
        """

    @property
    def findings(self) -> tuple[Diagnostic, ...]:
        """The defects of the file as a whole that do not prevent reading."""

    def batches(
        self, machine: Machine, collector: Collector, topic_map: Mapping[str, str]
    ) -> Iterator[Batch]:
        """The messages for a machine. Messages have the order of their stamps, rows of a CSV file
        the order of the file.

        `topic_map` maps topics of the rules to recorded topics. `collector` gets a report of
        unsuitable topics at the call, and of unreadable messages at the end of the iteration.
        Raises `RecordingError` at the call if there is nothing to read.
        """

    def frames(self) -> FramesFound:
        """The frames in the recording's transforms and headers."""

    def survey(self, observers: Mapping[str, Observe], seconds: float) -> Survey:
        """Read the topics of `observers`, and the transforms, for at most this number of seconds.

        Each observer gets messages of its topic, evenly spread over the recording: all, or some
        thousand. Messages that cannot be decoded, or that an observer rejects, are skipped.
        """

    def definitions(self) -> Mapping[str, str]:
        """The texts of .msg files in the recording, for types outside the standard packages, by
        names such as `my_msgs/Wheel`.
        """

    def close(self) -> None:
        """Release the file."""

    def __enter__(self) -> Recording:
        """Return the recording itself."""

    def __exit__(self, *reason: object) -> None:
        """Release the file."""
