"""The frames of a recording: those that it has transforms of, and those that headers say."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from rosbags.interfaces import Nodetype
from rosbags.typesys.store import Typestore

from rossmarie.ir import bare_frame
from rossmarie.recordings.decoding import DECODE_FAILURES, decoding_of
from rossmarie.recordings.definitions import UndefinedTypeError, full_type
from rossmarie.recordings.model import FramesFound, Transforms
from rossmarie.recordings.stored import Connection, Packed
from rossmarie.recordings.transforms import holds_transforms

_STATIC = "tf_static"
_MOST_HEADERS = 50
"""Messages of a topic whose headers are looked at."""
_MOST_FRAMES = 1000

Read = Callable[[bytes], Any]


@dataclass
class _Seen:
    """The frames that headers of a topic say so far."""

    read: Read
    count: int = 0
    frames: set[str] = field(default_factory=set)


def frames_in(
    connections: Mapping[str, Sequence[Connection]],
    store_of: Callable[[Connection], Typestore],
    batches: Callable[[Iterable[str]], Iterable[Packed]],
) -> FramesFound:
    """Read the frames of a recording. What cannot be decoded is passed over."""
    of_transforms: dict[str, Read] = {}
    of_headers: dict[str, _Seen] = {}
    for topic, (first, *_) in connections.items():
        try:
            store = store_of(first)
        except UndefinedTypeError:
            continue
        if holds_transforms(store, first.message_type):
            of_transforms[topic] = decoding_of(first, store)
        elif _has_header(store, first.message_type):
            of_headers[topic] = _Seen(decoding_of(first, store))
    found: dict[tuple[str, str], _Edge] = {}
    for batch in batches([*of_transforms, *of_headers]):
        _look_at(batch, of_transforms, of_headers, found)
    transforms = [
        Transforms(parent, child, each.is_static, each.count, each.longest_ns)
        for (parent, child), each in sorted(found.items())
    ]
    headers = {
        topic: next(iter(seen.frames))
        for topic, seen in of_headers.items()
        if len(seen.frames) == 1 and "" not in seen.frames
    }
    return FramesFound(transforms, headers)


@dataclass
class _Edge:
    """One transform as it has come so far."""

    is_static: bool
    count: int = 0
    last_ns: int = 0
    longest_ns: int = 0

    def note(self, at_ns: int) -> None:
        """Take in that it came."""
        if self.count:
            self.longest_ns = max(self.longest_ns, at_ns - self.last_ns)
        self.count, self.last_ns = self.count + 1, at_ns


def _look_at(
    batch: Packed,
    of_transforms: Mapping[str, Read],
    of_headers: Mapping[str, _Seen],
    found: dict[tuple[str, str], _Edge],
) -> None:
    for row in range(len(batch)):
        topic = batch.connections[batch.senders[row]].topic
        seen = of_headers.get(topic)
        if seen is not None and seen.count >= _MOST_HEADERS:
            continue
        try:
            if seen is not None:
                seen.count += 1
                seen.frames.add(seen.read(batch.message(row)).header.frame_id)
                continue
            message = of_transforms[topic](batch.message(row))
        except DECODE_FAILURES:
            continue
        for each in message.transforms:
            edge = bare_frame(each.header.frame_id), bare_frame(each.child_frame_id)
            if edge in found or len(found) < _MOST_FRAMES:
                known = found.setdefault(edge, _Edge(topic.endswith(_STATIC)))
                known.note(int(batch.times_ns[row]))


def _has_header(store: Typestore, message_type: str) -> bool:
    name = full_type(message_type)
    fields = dict(store.fielddefs[name][1]) if name in store.fielddefs else {}
    return fields.get("header") == (Nodetype.NAME, "std_msgs/msg/Header")
