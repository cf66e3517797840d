"""Small real recordings of every kind, and a machine that reads them."""

from __future__ import annotations

import struct
from binascii import crc32
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

import numpy as np
from rosbags import rosbag1
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore
from rosbags.typesys.store import Typestore

from dslkit.diagnostics import Collector, Diagnostic
from dslkit.source import SourceFile, Span
from rossmarie.ir import Array, Channel, FieldKind, Input, List, Machine, Slot, Step
from rossmarie.recordings.batches import updates_in
from rossmarie.recordings.model import Update
from rossmarie.recordings.opening import open_recording

START_NS = 1_700_000_000_000_000_000
ROS1 = get_typestore(Stores.ROS1_NOETIC)
ROS2 = get_typestore(Stores.ROS2_HUMBLE)

Reading = tuple[str, int, str, Any]
"""Topic, stamp, message type and message, which may be encoded already."""

RULES = SourceFile(
    "rules.ross", "input battery\ninput speed\ninput scan\ninput mode\ninput blocked"
)


def span_of(text: str) -> Span:
    start = RULES.text.index(text)
    return Span(RULES, start, start + len(text))


def slot(reader: int, *path: Step, kind: FieldKind = FieldKind.REAL) -> Slot:
    return Slot(reader, path, kind, 1.0, 0.0, "")


def machine(
    channels: Sequence[tuple[str, str]],
    inputs: Sequence[tuple[str, int]],
    slots: Sequence[Slot] = (),
    arrays: Sequence[Array] = (),
    texts: Sequence[str] = (),
    lists: Sequence[List] = (),
) -> Machine:
    """A machine that only reads; `inputs` are names (in `RULES`) and channels."""
    return Machine(
        name="test",
        channels=tuple(Channel(topic, message_type) for topic, message_type in channels),
        inputs=tuple(
            Input(name, channel, None, span_of(f"input {name}")) for name, channel in inputs
        ),
        slots=tuple(slots),
        arrays=tuple(arrays),
        texts=tuple(texts),
        lists=tuple(lists),
        signals=(),
        propositions=(),
        rules=(),
    )


BATTERY = machine([("/battery", "std_msgs/Float32")], [("battery", 0)], [slot(0, "data")])


def stamped(ros: Typestore, index: int) -> Any:
    """A header; that of ROS 1 has a counter as well."""
    at_ns = START_NS + index * 100_000_000
    stamp = ros.types["builtin_interfaces/msg/Time"](
        sec=at_ns // 1_000_000_000, nanosec=at_ns % 1_000_000_000
    )
    counter = {"seq": index} if ros is ROS1 else {}
    return ros.types["std_msgs/msg/Header"](**counter, stamp=stamp, frame_id="laser")


def battery(ros: Typestore, volts: float) -> tuple[str, Any]:
    return "std_msgs/msg/Float32", ros.types["std_msgs/msg/Float32"](data=volts)


def scan(ros: Typestore, index: int, ranges: Sequence[float]) -> tuple[str, Any]:
    name = "sensor_msgs/msg/LaserScan"
    return name, ros.types[name](
        header=stamped(ros, index),
        angle_min=0.0,
        angle_max=1.0,
        angle_increment=0.5,
        time_increment=0.0,
        scan_time=0.1,
        range_min=0.1,
        range_max=9.0,
        ranges=np.array(ranges, dtype=np.float32),
        intensities=np.zeros(0, dtype=np.float32),
    )


def readings(ros: Typestore, count: int = 10) -> list[Reading]:
    """`count` times 10 Hz: volts 12.0, 12.5 ... on /battery, scans on /scan 10 ms later."""
    found: list[Reading] = []
    for index in range(count):
        at_ns = START_NS + index * 100_000_000
        found.append(("/battery", at_ns, *battery(ros, 12.0 + index / 2)))
        found.append(("/scan", at_ns + 10_000_000, *scan(ros, index, [1.0, 2.0 + index])))
    return found


def encoded(ros: Typestore, name: str, message: Any) -> bytes:
    """A message as it is stored."""
    if isinstance(message, bytes):
        return message
    serialize = ros.serialize_ros1 if ros is ROS1 else ros.serialize_cdr
    return bytes(serialize(message, name))


def write_ros1(
    path: Path,
    found: Sequence[Reading],
    chunk_size: int = 300,
    compression: rosbag1.Writer.CompressionFormat | None = None,
) -> Path:
    writer = rosbag1.Writer(path)
    if compression is not None:
        writer.set_compression(compression)
    writer.chunk_threshold = chunk_size
    with writer:
        connections = {
            (topic, name): writer.add_connection(topic, name, typestore=ROS1)
            for topic, name in {(topic, name): None for topic, _, name, _ in found}
        }
        for topic, at_ns, name, message in found:
            writer.write(connections[topic, name], at_ns, encoded(ROS1, name, message))
    return path


def write_ros2(
    folder: Path,
    found: Sequence[Reading],
    plugin: StoragePlugin,
    compression: CompressionMode = CompressionMode.NONE,
    version: Literal[8, 9] = 9,
) -> Path:
    """A bag directory."""
    writer = Writer(folder, version=version, storage_plugin=plugin)
    writer.set_compression(compression, CompressionFormat.ZSTD)
    with writer:
        connections = {
            (topic, name): writer.add_connection(topic, name, typestore=ROS2)
            for topic, name in {(topic, name): None for topic, _, name, _ in found}
        }
        for topic, at_ns, name, message in found:
            writer.write(connections[topic, name], at_ns, encoded(ROS2, name, message))
    return folder


KINDS = ("bag", "db3", "db3 directory", "mcap", "mcap directory", "compressed mcap")


def write_kind(folder: Path, kind: str, found: Sequence[Reading]) -> Path:
    """A recording of one of `KINDS` in `folder`; messages are given for ROS 1 or ROS 2."""
    if kind == "bag":
        return write_ros1(folder / "drive.bag", found)
    plugin = StoragePlugin.SQLITE3 if kind.startswith("db3") else StoragePlugin.MCAP
    is_compressed = kind.startswith("compressed")
    mode = CompressionMode.STORAGE if is_compressed else CompressionMode.NONE
    written = write_ros2(folder / "drive", found, plugin, mode)
    if kind.endswith("directory"):
        return written
    return next(file for file in written.iterdir() if file.suffix in (".db3", ".mcap"))


def write_mcap(
    path: Path,
    profile: str,
    schema: tuple[str, str, str],
    channel: tuple[str, str],
    messages: Sequence[tuple[int, bytes]],
    checksums: Sequence[int] = (),
) -> Path:
    """A bare MCAP file without summary, record by record (https://mcap.dev/spec).

    `schema` is name, encoding and text; `channel` is topic and message encoding. Messages are not
    in chunks, or each in one of its own with its part of `checksums` (-1: the right one).
    """

    def text(*values: str) -> bytes:
        parts = [value.encode() for value in values]
        return b"".join(struct.pack("<I", len(part)) + part for part in parts)

    def record(operation: int, content: bytes) -> bytes:
        return struct.pack("<BQ", operation, len(content)) + content

    def chunk(at: int, content: bytes, checksum: int) -> bytes:
        checksum = crc32(content) if checksum == -1 else checksum
        head = struct.pack("<QQQI", at, at, len(content), checksum) + text("")
        return record(0x06, head + struct.pack("<Q", len(content)) + content)

    stored = [record(0x05, struct.pack("<HIQQ", 1, 0, at, at) + c) for at, c in messages]
    if checksums:
        stamps = [at for at, _ in messages]
        stored = [chunk(*part) for part in zip(stamps, stored, checksums, strict=True)]
    magic = b"\x89MCAP0\r\n"
    records = [
        record(0x01, text(profile, "by hand")),
        record(0x03, struct.pack("<H", 1) + text(*schema)),
        record(0x04, struct.pack("<HH", 1, 1) + text(*channel) + struct.pack("<I", 0)),
        *stored,
        record(0x0F, struct.pack("<I", 0)),
        record(0x02, struct.pack("<QQI", 0, 0, 0)),
    ]
    path.write_bytes(magic + b"".join(records) + magic)
    return path


def store_of(kind: str) -> Typestore:
    """The message types that recordings of a kind are written with."""
    return ROS1 if kind == "bag" else ROS2


def replay(
    path: Path,
    rules: Machine = BATTERY,
    topic_map: Mapping[str, str] = MappingProxyType({}),
) -> tuple[list[Update], tuple[Diagnostic, ...]]:
    """All updates of a recording, and what was reported on the way."""
    collector = Collector()
    with open_recording(path) as recording:
        found = list(updates_in(rules, recording.batches(rules, collector, topic_map)))
    return found, collector.sorted()


def codes(found: Sequence[Diagnostic]) -> list[str]:
    return [diagnostic.code for diagnostic in found]


def volts(updates: Sequence[Update], slot_index: int = 0) -> list[float]:
    return [values.slots[slot_index] for update in updates for values in update.channels.values()]
