"""The frames of a recording: frames in transforms, and frames in headers."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from rosbags.interfaces import Nodetype
from rosbags.typesys.store import Typestore

from rossmarie.ir import bare_frame
from rossmarie.recordings.decoding import DECODE_FAILURES, decoding_of
from rossmarie.recordings.definitions import UndefinedTypeError, full_type
from rossmarie.recordings.model import FramesFound, Transforms
from rossmarie.recordings.stored import Packed, RecordedConnection
from rossmarie.recordings.transforms import holds_transforms

_STATIC = "tf_static"
_MOST_HEADERS = 50
"""The messages of a topic whose headers are read."""
_MOST_FRAMES = 1000

Read = Callable[[bytes], Any]


@dataclass
class _Seen:
    """The frames in the headers of a topic so far."""

    read: Read
    count: int = 0
    frames: set[str] = field(default_factory=set)


@dataclass
class _Edge:
    """The messages with one transform so far: their count, and the longest time between two of
    them.
    """

    is_static: bool
    count: int = 0
    last_ns: int = 0
    longest_ns: int = 0

    def note(self, at_ns: int) -> None:
        """Note that the transform came."""
        if self.count:
            self.longest_ns = max(self.longest_ns, at_ns - self.last_ns)
        self.count, self.last_ns = self.count + 1, at_ns


class FrameSearch:
    """Searches for the frames of a recording in its messages. Messages that cannot be decoded are
    skipped.

    `headers_of` are the topics whose headers are read; None means all topics.
    """

    def __init__(
        self,
        connections: Mapping[str, Sequence[RecordedConnection]],
        store_of: Callable[[RecordedConnection], Typestore],
        headers_of: Collection[str] | None = None,
    ) -> None:
        self._of_transforms: dict[str, Read] = {}
        self._of_headers: dict[str, _Seen] = {}
        self._found: dict[tuple[str, str], _Edge] = {}
        for topic, (first, *_) in connections.items():
            try:
                store = store_of(first)
            except UndefinedTypeError:
                continue
            if holds_transforms(store, first.message_type):
                self._of_transforms[topic] = decoding_of(first, store)
            elif headers_of is not None and topic not in headers_of:
                continue
            elif _has_header(store, first.message_type):
                self._of_headers[topic] = _Seen(decoding_of(first, store))

    @property
    def topics(self) -> Collection[str]:
        """The topics whose messages contain frames."""
        return [*self._of_transforms, *self._of_headers]

    def note(self, batch: Packed) -> None:
        """Note the next messages, in the order of their stamps."""
        for row in range(len(batch)):
            topic = batch.connections[batch.senders[row]].topic
            try:
                if topic in self._of_transforms:
                    self._note_transforms(topic, batch, row)
                elif topic in self._of_headers:
                    self._note_header(self._of_headers[topic], batch, row)
            except DECODE_FAILURES:
                continue

    def found(self) -> FramesFound:
        """The frames so far."""
        transforms = [
            Transforms(parent, child, each.is_static, each.count, each.longest_ns)
            for (parent, child), each in sorted(self._found.items())
        ]
        headers = {
            topic: next(iter(seen.frames))
            for topic, seen in self._of_headers.items()
            if len(seen.frames) == 1 and "" not in seen.frames
        }
        return FramesFound(transforms, headers)

    def _note_transforms(self, topic: str, batch: Packed, row: int) -> None:
        message = self._of_transforms[topic](batch.message(row))
        for each in message.transforms:
            edge = bare_frame(each.header.frame_id), bare_frame(each.child_frame_id)
            if edge in self._found or len(self._found) < _MOST_FRAMES:
                known = self._found.setdefault(edge, _Edge(topic.endswith(_STATIC)))
                known.note(int(batch.times_ns[row]))

    def _note_header(self, seen: _Seen, batch: Packed, row: int) -> None:
        if seen.count < _MOST_HEADERS:
            seen.count += 1
            seen.frames.add(seen.read(batch.message(row)).header.frame_id)


def frames_in(
    connections: Mapping[str, Sequence[RecordedConnection]],
    store_of: Callable[[RecordedConnection], Typestore],
    batches: Callable[[Iterable[str]], Iterable[Packed]],
) -> FramesFound:
    """Read the frames of a recording. Messages that cannot be decoded are skipped."""
    search = FrameSearch(connections, store_of)
    for batch in batches(search.topics):
        search.note(batch)
    return search.found()


def _has_header(store: Typestore, message_type: str) -> bool:
    name = full_type(message_type)
    fields = dict(store.fielddefs[name][1]) if name in store.fielddefs else {}
    return fields.get("header") == (Nodetype.NAME, "std_msgs/msg/Header")
