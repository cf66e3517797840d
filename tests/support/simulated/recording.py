"""Recordings of simulated robots: what sensors say, at their rates, in one MCAP file.

Numbers are rounded to halves of halves, and there is no noise: so files stay small.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from rossmarie.driver.robots import BuiltInRobot
from support.made_messages import made

START_NS = 1_750_000_000_000_000_000
SPLIT_NS = 1_000_000
"""After the beginning no two sensors speak at one instant: else their order would decide."""

Reading = tuple[str, int, str, Any]
"""Topic, stamp, message type and message."""


@dataclass(frozen=True)
class Sensor:
    """A source of messages on a topic: the fields of its message at an instant (s)."""

    topic: str
    type: str
    times: Sequence[float]
    read: Callable[[float], dict[str, Any] | None]
    frame: str | None = None
    silent: Sequence[tuple[float, float]] = ()
    hangs: Sequence[tuple[float, float]] = ()
    """Stretches in which its driver sends its last message again and again, with the old stamp."""

    def measured_at(self, at_ns: int) -> int:
        """The instant of what it sends at an instant (ns)."""
        stuck = [round(begin * 1e9) for begin, end in self.hangs if begin <= at_ns / 1e9 < end]
        return stuck[0] if stuck else at_ns


def every(rate: float, seconds: float) -> Sequence[float]:
    """Instants at a rate (Hz)."""
    return [number / rate for number in range(round(seconds * rate))]


def during(t: float, *stretches: tuple[float, float]) -> bool:
    """Say whether an instant lies in one of the stretches."""
    return any(begin <= t < end for begin, end in stretches)


def rounded(value: float, bits: int = 10) -> float:
    """The nearest multiple of a power of two: few digits, which are packed well."""
    return round(math.ldexp(value, bits)) / (1 << bits)


def store_of(robot: BuiltInRobot, stores: Stores = Stores.ROS2_HUMBLE) -> Typestore:
    """The types of ROS, and those of a robot."""
    store = get_typestore(stores)
    found = {}
    for path in sorted(robot.folder.glob("msg/*/msg/*.msg")):
        name = f"{path.parts[-3]}/msg/{path.stem}"
        found.update(get_types_from_msg(path.read_text(encoding="utf-8"), name))
    store.register(found)
    return store


def readings(store: Typestore, sensors: Sequence[Sensor]) -> Iterator[Reading]:
    """The messages of sensors, in the order of time."""
    due = sorted(
        (round(t * 1e9) + (index * SPLIT_NS if t > 0 else 0), index)
        for index, sensor in enumerate(sensors)
        for t in sensor.times
        if not during(t, *sensor.silent)
    )
    for at_ns, index in due:
        sensor = sensors[index]
        measured_ns = sensor.measured_at(at_ns)
        fields = sensor.read(measured_ns / 1e9)
        if fields is None:
            continue
        if sensor.frame is not None:
            fields |= header(measured_ns, sensor.frame)
        name = sensor.type.replace("/", "/msg/")
        yield sensor.topic, START_NS + at_ns, name, made(store, sensor.type, **fields)


def header(at_ns: int, frame: str) -> dict[str, Any]:
    """The fields of a header."""
    seconds, nanoseconds = divmod(START_NS + at_ns, 1_000_000_000)
    return {
        "header__stamp__sec": seconds,
        "header__stamp__nanosec": nanoseconds,
        "header__frame_id": frame,
    }


def write(path: Path, store: Typestore, found: Iterable[Reading]) -> None:
    """Write a recording; one that is there is replaced."""
    with TemporaryDirectory(dir=path.parent) as scratch:
        folder = Path(scratch) / path.stem
        write_bag(folder, store, found)
        (written,) = folder.glob("*.mcap")
        path.write_bytes(without_index(written.read_bytes()))


_MAGIC = b"\x89MCAP0\r\n"
_KEPT = {0x01: "header", 0x06: "chunk", 0x0C: "metadata", 0x0F: "end of data"}
_FOOTER = struct.pack("<BQQQI", 0x02, 20, 0, 0, 0)


def without_index(content: bytes) -> bytes:
    """An MCAP file (https://mcap.dev/spec) without the places of its messages: they would take half
    of it, and readers find messages without.
    """
    found, at = [_MAGIC], len(_MAGIC)
    while at < len(content) - len(_MAGIC):
        operation, length = struct.unpack_from("<BQ", content, at)
        end = at + 9 + length
        if operation in _KEPT:
            found.append(content[at:end])
        at = end
    return b"".join([*found, _FOOTER, _MAGIC])


def write_bag(folder: Path, store: Typestore, found: Iterable[Reading]) -> None:
    """Write a folder with a recording and what describes it, as robots with ROS 2 do."""
    writer = Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP)
    writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
    with writer:
        connections: dict[str, Any] = {}
        for topic, at_ns, name, message in found:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, name, typestore=store)
            writer.write(connections[topic], at_ns, store.serialize_cdr(message, name))
