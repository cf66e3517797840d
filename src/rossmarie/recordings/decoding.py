"""Decodes the messages of one topic into the columns that a machine reads.

Nearly all messages are decoded together, by a plan. rosbags decodes messages without a plan, and
messages that a plan cannot decode. If rosbags also fails, the reason is recorded.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from rosbags.serde import SerdeError
from rosbags.typesys.store import Typestore

from rossmarie.ir.clouds import UnreadableCloudError
from rossmarie.ir.scans import UnreadableScanError
from rossmarie.recordings.definitions import full_type
from rossmarie.recordings.elements import ElementSearch
from rossmarie.recordings.extraction import Message, WantedParts, compile_extractor
from rossmarie.recordings.limits import LimitError
from rossmarie.recordings.message_sizes import Sizes
from rossmarie.recordings.planning import plan_for
from rossmarie.recordings.sheet import SheetValues, nothing_found
from rossmarie.recordings.stored import Packed, RecordedConnection
from rossmarie.recordings.walking import walk

DECODE_FAILURES: tuple[type[Exception], ...] = (
    SerdeError,
    ArithmeticError,
    AssertionError,
    LookupError,
    MemoryError,
    TypeError,
    ValueError,
)
"""The exceptions that decoding raises on content that does not match its definition."""

_NOT_READ = float("nan")


@dataclass(frozen=True, eq=False)
class Decoded:
    """The values of each message, by slot and by array of the machine. `failures` are messages with
    the reason for unknown values. In undecodable messages all values are unknown. In messages with
    a partly unreadable cloud or scan, the arrays of the cloud or scan are None.
    """

    slots: Mapping[int, NDArray[np.float64]]
    arrays: Mapping[int, Sequence[NDArray[np.generic] | None]]
    failures: Sequence[tuple[int, str]]


class Decoder:
    """Decodes messages of a connection, or of other connections on its topic. `missing` are the
    wanted fields that the definition does not contain.
    """

    def __init__(
        self,
        connection: RecordedConnection,
        store: Typestore,
        wanted: WantedParts,
        texts: Sequence[str],
    ) -> None:
        self._name = full_type(connection.message_type)
        self._message = decoding_of(connection, store)
        self._most = Sizes(store.fielddefs).largest_message(self._name)
        extractor = compile_extractor(store, connection.message_type, wanted, texts)
        self._read, self._found = extractor.read, extractor.found
        self._sensed = extractor.sensed
        self.missing = extractor.missing
        self._searches = extractor.searches
        self._plan = plan_for(store, connection.message_type, connection.encoding, self._found)
        self._texts = {text.encode(): float(number) for number, text in enumerate(texts)}

    @property
    def never_found(self) -> Iterator[ElementSearch]:
        """The elements that no message has had so far, although some messages had other
        elements.
        """
        return (each for each in self._searches if each.is_vain)

    def decode(self, messages: Packed) -> Decoded:
        """The values of some messages."""
        found = self._walked(messages)
        failures = []
        for row in np.flatnonzero(~found.is_done).tolist():
            reason = self._decode_alone(messages.message(row), row, found)
            if reason is not None:
                failures.append((row, reason))
        return Decoded(found.slots, found.arrays, failures)

    def _walked(self, messages: Packed) -> SheetValues:
        if self._plan is None:
            return nothing_found(len(messages), self._found.slots, self._found.arrays)
        starts, ends = messages.starts, messages.ends
        if self._most is not None:  # nothing is read from messages that are too large
            ends = np.where(ends - starts > self._most, starts, ends)
        return walk(self._plan, self._texts, messages.content, starts, ends)

    def _decode_alone(self, content: bytes, row: int, found: SheetValues) -> str | None:
        """Decode one message with rosbags. Returns the reason if that is not possible."""
        try:
            message = self._message(content)
            values = self._read(message)
        except DECODE_FAILURES as error:
            for each in found.arrays.values():
                each[row] = None
            return str(error) or type(error).__name__
        for slot, column in found.slots.items():
            column[row] = values.slots.get(slot, _NOT_READ)
        for array, elements in values.arrays.items():
            found.arrays[array][row] = np.array(elements, np.float64)
        return self._take_sensed(message, row, found)

    def _take_sensed(self, message: Message, row: int, found: SheetValues) -> str | None:
        """Take the points of clouds and the beams of scans. Returns the reason if some are unknown
        (S56, S70).
        """
        reason = None
        for each in self._sensed:
            try:
                columns: Mapping[int, NDArray[np.float64] | None] = each.read(message)
            except (UnreadableCloudError, UnreadableScanError) as error:
                reason, columns = str(error), dict.fromkeys(each.columns)
            for array, elements in columns.items():
                found.arrays[array][row] = elements
        return reason


def decoding_of(connection: RecordedConnection, store: Typestore) -> Callable[[bytes], Message]:
    """The decoder of rosbags for messages of a connection, or of other connections on its topic.
    The decoder raises one of `DECODE_FAILURES`, also for a message that is too large.
    """
    name = full_type(connection.message_type)
    is_ros1 = connection.encoding == "ros1"
    decode = store.deserialize_ros1 if is_ros1 else store.deserialize_cdr
    most = Sizes(store.fielddefs).largest_message(name)

    def decoded(content: bytes) -> Message:
        if most is not None and len(content) > most:
            raise LimitError(f"it is larger than {most >> 20} MiB, the limit for its type")
        return decode(content, name)

    return decoded
