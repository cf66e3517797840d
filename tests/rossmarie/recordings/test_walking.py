"""Fields that are found in all messages at once are those that rosbags decodes one by one."""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rosbags.interfaces import MessageDefinition, MessageDefinitionFormat, Nodetype
from rosbags.typesys import Stores, get_typestore

from rossmarie.ir import ChannelValues
from rossmarie.recordings import walking
from rossmarie.recordings.decoding import DECODE_FAILURES, Decoder
from rossmarie.recordings.extraction import compile_extractor
from rossmarie.recordings.planning import plan_for
from rossmarie.recordings.stored import Packed, RecordedConnection, Stored, packed
from support.depth import examples
from support.messages import TEXTS, Described, all_fields, described, message

FORMS = ("ros1", "little", "big")
Exact = tuple[list[str], list[list[str]]]


def encoded(of: Described, value: Any, form: str) -> bytes:
    if form == "ros1":
        return bytes(of.store.serialize_ros1(value, of.name))
    return bytes(of.store.serialize_cdr(value, of.name, little_endian=form == "little"))


def connection_of(of: Described, form: str) -> RecordedConnection:
    undefined = MessageDefinition(MessageDefinitionFormat.NONE, "")
    encoding = "ros1" if form == "ros1" else "cdr"
    return RecordedConnection(1, "/odd", of.name.replace("/msg/", "/"), encoding, undefined, 1)


def packed_in_one(connection: RecordedConnection, contents: Sequence[bytes]) -> Packed:
    (batch,) = packed(Stored(connection, at_ns, each) for at_ns, each in enumerate(contents))
    return batch


def one_by_one(
    of: Described, connection: RecordedConnection, contents: Sequence[bytes]
) -> list[object]:
    """Each message as rosbags decodes it, or the reason why rosbags does not."""
    is_ros1 = connection.encoding == "ros1"
    decode = of.store.deserialize_ros1 if is_ros1 else of.store.deserialize_cdr
    read = compile_extractor(of.store, connection.message_type, all_fields(of), TEXTS).read

    def decoded(content: bytes) -> object:
        try:
            return exactly(read(decode(content, of.name)))
        except DECODE_FAILURES as error:
            return str(error)

    return [decoded(content) for content in contents]


def listed(elements: np.ndarray | None) -> list[float]:
    return [] if elements is None else elements.astype(np.float64).tolist()


def all_at_once(
    of: Described, connection: RecordedConnection, contents: Sequence[bytes]
) -> list[object]:
    decoder = Decoder(connection, of.store, all_fields(of), TEXTS)
    decoded = decoder.decode(packed_in_one(connection, contents))
    failures = dict(decoded.failures)
    found: list[object] = []
    for row in range(len(contents)):
        slots = {slot: float(column[row]) for slot, column in decoded.slots.items()}
        with np.errstate(invalid="ignore"):
            arrays = {array: listed(elements[row]) for array, elements in decoded.arrays.items()}
        values = exactly(ChannelValues(slots, arrays))
        found.append(failures.get(row, values))
        if row in failures:
            assert all(map(math.isnan, slots.values()))
            assert not any(arrays.values())
    return found


def exactly(values: ChannelValues) -> Exact:
    """Numbers by their bits; any NaN is like any other."""
    arrays = (dict(enumerate(each)) for _, each in sorted(values.arrays.items()))
    return in_bits(values.slots), [in_bits(each) for each in arrays]


def in_bits(numbers: Mapping[int, float]) -> list[str]:
    values = (value for _, value in sorted(numbers.items()))
    return ["nan" if value != value else struct.pack("<d", value).hex() for value in values]


@st.composite
def recorded(draw: st.DrawFn) -> tuple[Described, str, list[bytes]]:
    of = draw(described())
    form = draw(st.sampled_from(FORMS))
    messages = draw(st.lists(message(of), min_size=1, max_size=4))
    return of, form, [encoded(of, each, form) for each in messages]


@settings(max_examples=examples(4))
@given(recorded())
def test_all_fields_of_any_message(case: tuple[Described, str, list[bytes]]) -> None:
    of, form, contents = case
    connection = connection_of(of, form)
    assert all_at_once(of, connection, contents) == one_by_one(of, connection, contents)


@settings(max_examples=examples(2))
@given(recorded())
def test_whole_messages_are_not_left_to_rosbags(case: tuple[Described, str, list[bytes]]) -> None:
    of, form, contents = case
    connection = connection_of(of, form)
    plan = plan_for(of.store, connection.message_type, connection.encoding, all_fields(of))
    assert plan is not None
    batch = packed_in_one(connection, contents)
    assert walking.walk(plan, {}, batch.content, batch.starts, batch.ends).is_done.all()


@st.composite
def damaged(draw: st.DrawFn) -> tuple[Described, str, list[bytes]]:
    """The same with bytes that are wrong, or missing, or too many."""
    of, form, contents = draw(recorded())
    return of, form, [draw(_damaged(content)) for content in contents]


@st.composite
def _damaged(draw: st.DrawFn, content: bytes) -> bytes:
    start = draw(st.integers(0, len(content)))
    end = draw(st.sampled_from((start, start + 1, start + 4, len(content))))
    instead = draw(st.sampled_from((b"", b"\0", b"\xff", b"\2\0\0\0", b"\xff\xff\xff\xff")))
    return content[:start] + instead + content[end:]


@settings(max_examples=examples(4))
@given(damaged())
def test_damaged_messages_are_reported_as_before(case: tuple[Described, str, list[bytes]]) -> None:
    of, form, contents = case
    connection = connection_of(of, form)
    assert all_at_once(of, connection, contents) == one_by_one(of, connection, contents)


@settings(max_examples=examples(1))
@given(recorded())
def test_long_arrays_of_messages_are_left_to_rosbags(
    case: tuple[Described, str, list[bytes]],
) -> None:
    of, form, contents = case
    connection = connection_of(of, form)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(walking, "_MOST_RECORDS", 1)
        assert all_at_once(of, connection, contents) == one_by_one(of, connection, contents)


SIGNALLING = struct.pack("<I", 0x7F800001)


def test_a_nan_of_another_kind_is_unknown_and_no_warning() -> None:
    """Warnings fail a test: numpy gives one where it makes a plain NaN of such a one."""
    store = get_typestore(Stores.EMPTY)
    fields: list[Any] = [
        ("one", (Nodetype.BASE, ("float32", 0))),
        ("many", (Nodetype.SEQUENCE, ((Nodetype.BASE, ("float32", 0)), 0))),
    ]
    store.register({"odd_msgs/msg/Single": ([], fields)})
    of = Described(store, "odd_msgs/msg/Single")
    contents = [SIGNALLING + struct.pack("<I", 1) + SIGNALLING]
    connection = connection_of(of, "ros1")
    assert all_at_once(of, connection, contents) == one_by_one(of, connection, contents)
