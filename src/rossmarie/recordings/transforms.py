"""Transforms between frames in the messages of recordings (S79)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from operator import attrgetter
from typing import Any

from rosbags.interfaces import Nodetype
from rosbags.typesys.store import Typestore

from dslkit.diagnostics import Diagnostic
from rossmarie.ir import ChannelValues, Edge, Machine, Slot, bare_frame
from rossmarie.recordings.decoding import DECODE_FAILURES, decoding_of
from rossmarie.recordings.definitions import full_type
from rossmarie.recordings.errors import NameNeverRecorded
from rossmarie.recordings.matching import Match, input_span, listed
from rossmarie.recordings.stored import Packed, RecordedConnection

_MOST_OTHERS = 64
"""The transforms that are kept for a message. A reader needs no more."""

_NUMBER: Any = (Nodetype.BASE, ("float64", 0))
_TEXT: Any = (Nodetype.BASE, ("string", 0))
_HEADER = "std_msgs/msg/Header"
_STAMPED = "geometry_msgs/msg/TransformStamped"
_TRANSFORM = "geometry_msgs/msg/Transform"
_VECTOR, _QUATERNION = "geometry_msgs/msg/Vector3", "geometry_msgs/msg/Quaternion"
_NEEDED: Any = {
    _STAMPED: {
        "header": (Nodetype.NAME, _HEADER),
        "child_frame_id": _TEXT,
        "transform": (Nodetype.NAME, _TRANSFORM),
    },
    _HEADER: {"frame_id": _TEXT},
    _TRANSFORM: {"translation": (Nodetype.NAME, _VECTOR), "rotation": (Nodetype.NAME, _QUATERNION)},
    _VECTOR: dict.fromkeys("xyz", _NUMBER),
    _QUATERNION: dict.fromkeys("xyzw", _NUMBER),
}
"""The fields that transforms depend on, in the form of rosbags."""


def holds_transforms(store: Typestore, message_type: str) -> bool:
    """Say whether messages of a type, in a recording's definition, have a list of transforms."""
    name = full_type(message_type)
    transforms = (
        dict(store.fielddefs[name][1]).get("transforms") if name in store.fielddefs else None
    )
    if transforms is None or transforms[0] not in (Nodetype.ARRAY, Nodetype.SEQUENCE):
        return False
    if transforms[1][0] != (Nodetype.NAME, _STAMPED):
        return False
    for kind, needed in _NEEDED.items():
        has = dict(store.fielddefs[kind][1]) if kind in store.fielddefs else {}
        if any(has.get(name) != described for name, described in needed.items()):
            return False
    return True


@dataclass
class _Search:
    """The search for one transform: its channel, and the values that the channel reads."""

    edge: Edge
    channel: int
    fields: Sequence[tuple[int, attrgetter[float]]]
    span_of: int
    is_found: bool = False


@dataclass
class TransformDecoder:
    """Decodes messages with transforms for the channels of some transforms. `others` are the first
    other transforms in the messages.
    """

    connection: RecordedConnection
    store: Typestore
    matches: Sequence[Match]
    machine: Machine
    others: dict[str, None] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._decode = decoding_of(self.connection, self.store)
        self._searches = [self._search(match) for match in self.matches]

    def _search(self, match: Match) -> _Search:
        edge = self.machine.channels[match.channel].edge
        assert edge is not None, "the channel of a transform"
        fields = [(index, attrgetter(_attribute(slot))) for index, slot in match.slots.items()]
        return _Search(edge, match.channel, fields, match.inputs[0])

    def decode(self, messages: Packed) -> Iterator[tuple[int, dict[int, ChannelValues] | str]]:
        """The values of each message, by channel, with its row; the reason if the message cannot be
        decoded.
        """
        for row in range(len(messages)):
            try:
                found = self._values(self._decode(messages.message(row)))
            except DECODE_FAILURES as error:
                yield row, str(error) or type(error).__name__
                continue
            yield row, found

    def _values(self, message: Any) -> dict[int, ChannelValues]:
        found: dict[int, ChannelValues] = {}
        for each in message.transforms:
            parent, child = bare_frame(each.header.frame_id), bare_frame(each.child_frame_id)
            is_wanted = False
            for search in self._searches:
                if search.edge.child != child:
                    continue
                is_wanted = search.edge.parent == parent
                search.is_found |= is_wanted
                numbers = {
                    slot: float(get(each.transform)) if is_wanted else math.nan
                    for slot, get in search.fields
                }
                found[search.channel] = ChannelValues(numbers, {})
            if not is_wanted and len(self.others) < _MOST_OTHERS:
                self.others[f"{child} in {parent}"] = None
        return found

    def never_found(self, topic: str) -> Iterator[Diagnostic]:
        """The findings about transforms that no message had."""
        for search in self._searches:
            if not search.is_found:
                finding = NameNeverRecorded(
                    topic=topic,
                    element=f"{search.edge.child} in {search.edge.parent}",
                    field=self.machine.inputs[search.span_of].name,
                    names=listed(self.others, none="no other"),
                )
                span = input_span(self.machine, search.span_of)
                yield finding.at(span, help=finding.Check())


def _attribute(slot: Slot) -> str:
    return ".".join(map(str, slot.path))
