"""The message records in a chunk of a ROS 1 bag, all at once.

A record is a header and a message, each after its length. A recorder always writes the same fields
of the header in the same order.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from rosbags.rosbag1.reader import RecordType

from rossmarie.recordings.gathering import values_at

_FIELDS = {b"conn": 4, b"op": 1, b"time": 8}
_LENGTH = 4
_HEADER = sum(_LENGTH + len(name) + len(b"=") + size for name, size in _FIELDS.items())
_HEAD = _LENGTH + _HEADER + _LENGTH


def message_places(
    content: bytes,
    offsets: NDArray[np.int64],
    numbers: NDArray[np.int64],
    times_ns: NDArray[np.int64],
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The start and the end of each message in the content of a chunk. The index gives their
    offsets, connections and stamps.

    Raises `ValueError` or `KeyError` for records that have another form or contradict the index.
    """
    heads = _heads(content, offsets)
    form = _Form(heads[0])
    are_same = (form.number(heads) == numbers) & (form.time_ns(heads) == times_ns)
    starts = offsets + _HEAD
    ends = starts + _integers(heads, _LENGTH + _HEADER)
    if not np.all(are_same & form.fits(heads) & (ends <= len(content))):
        raise ValueError("the index does not list all records")
    return starts, ends


def _heads(content: bytes, offsets: NDArray[np.int64]) -> NDArray[np.uint8]:
    """The bytes before messages: one row for each message."""
    if offsets.max() + _HEAD > len(content):
        raise ValueError("a record extends beyond its chunk")
    heads = values_at(content, f"V{_HEAD}", offsets)
    return heads.view(np.uint8).reshape(len(offsets), _HEAD)


def _integers(heads: NDArray[np.uint8], place: int) -> NDArray[np.int64]:
    """The numbers of four bytes at a place in each head."""
    return np.ascontiguousarray(heads[:, place : place + 4]).view("<u4")[:, 0].astype(np.int64)


class _Form:
    """The places of the fields in a head, taken from one head. Raises `ValueError` or `KeyError` if
    it is not the head of a message.
    """

    def __init__(self, head: NDArray[np.uint8]) -> None:
        self._shown = head
        self._is_value = np.zeros(_HEAD, np.bool_)
        self._is_value[-_LENGTH:] = True
        self._places: dict[bytes, int] = {}
        text, place = head.tobytes(), _LENGTH
        is_usual = text.startswith(_HEADER.to_bytes(_LENGTH, "little"))
        while place < _LENGTH + _HEADER:
            name = text[place + _LENGTH : text.index(b"=", place + _LENGTH)]
            size = len(name) + len(b"=") + _FIELDS[name]
            is_usual &= text[place : place + _LENGTH] == size.to_bytes(_LENGTH, "little")
            place += _LENGTH + size
            self._places[name] = place - _FIELDS[name]
            self._is_value[self._places[name] : place] = name != b"op"
        if not is_usual or text[self._places[b"op"]] != RecordType.MSGDATA:
            raise ValueError("a record of another kind")

    def fits(self, heads: NDArray[np.uint8]) -> NDArray[np.bool_]:
        """A mask of the heads with this form."""
        found: NDArray[np.bool_] = np.all((heads == self._shown) | self._is_value, axis=1)
        return found

    def number(self, heads: NDArray[np.uint8]) -> NDArray[np.int64]:
        """The numbers of the connections."""
        return _integers(heads, self._places[b"conn"])

    def time_ns(self, heads: NDArray[np.uint8]) -> NDArray[np.int64]:
        """The stamps in ns."""
        place = self._places[b"time"]
        return _integers(heads, place) * 10**9 + _integers(heads, place + 4)
