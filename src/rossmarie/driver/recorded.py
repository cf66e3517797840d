"""Every recorded number on the topics of a rules file, so that a reader can add it to a timeline.

The rules need few of these numbers, so the monitor does not read the others. The driver reads the
recording a second time, with a machine that has no rules and a slot for each number.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from dslkit.diagnostics import Collector
from dslkit.source import SourceFile, Span
from rossmarie.check.model import CheckedInput
from rossmarie.driver.sampler import Kept
from rossmarie.ir import AXES, Channel, FieldKind, Input, Machine, Slot, is_setting
from rossmarie.ir import Path as FieldPath
from rossmarie.ir.path import path_words
from rossmarie.recordings.errors import RecordingError
from rossmarie.recordings.model import Recording
from rossmarie.report.axis import Axis
from rossmarie.report.envelope import share
from rossmarie.report.model import Plot
from rossmarie.types import (
    Array,
    Boolean,
    Box,
    Entry,
    Interval,
    List,
    Message,
    Motion,
    Quantity,
    Quaternion,
    Region,
    Text,
    Type,
    Unknown,
    Unsupported,
    Vector,
)

MOST_SIGNALS = 200
"""The most signals of one timeline that a reader can add."""

_HEADER = "std_msgs/Header"


@dataclass(frozen=True)
class _Number:
    """A number in the messages on a channel; `unit` is empty if no unit is known.

    `name` is the first input that selects the number. Columns of a CSV file may have names of
    inputs.
    """

    channel: Channel
    path: FieldPath
    kind: FieldKind
    unit: str
    name: str = field(compare=False)

    @property
    def text(self) -> str:
        """The topic of the number and its path in the message."""
        return f"{self.channel.topic} {path_words(self.path)}"


def recorded_plots(
    recording: Recording,
    inputs: Sequence[CheckedInput],
    topic_map: Mapping[str, str],
    start_ns: int,
) -> tuple[Plot, ...]:
    """Sample the numbers on the topics of the inputs, at most `MOST_SIGNALS`.

    A number without any recorded value is left out. `start_ns` is the stamp at which the axis
    begins. The replay before has reported all findings, so this function reports none.
    """
    numbers = list(dict.fromkeys(_numbers_of(inputs)))[:MOST_SIGNALS]
    machine = _machine(numbers)
    topics = {each.topic for each in machine.channels}
    pairs = {wanted: recorded for wanted, recorded in topic_map.items() if wanted in topics}
    try:
        batches = recording.batches(machine, Collector(), pairs)
    except RecordingError:
        return ()
    axis, kept, limit = Axis(), [Kept() for _ in numbers], share(len(numbers))
    offset: int | None = None
    for batch in batches:
        if not len(batch.times_ns):
            continue
        offset = int(batch.times_ns[0]) - start_ns if offset is None else offset
        times = axis.place(batch.times_ns) + offset
        for index, slot in enumerate(machine.slots):
            rows = np.flatnonzero(batch.arriving[:, machine.inputs[slot.input].channel])
            kept[index].add(times[rows], batch.slots[rows, index], limit)
    return tuple(
        Plot(number.text, number.unit, samples.times / 1e9, samples.values, ())
        for number, samples in zip(numbers, kept, strict=True)
        if np.isfinite(samples.values).any()
    )


def _numbers_of(inputs: Sequence[CheckedInput]) -> Iterator[_Number]:
    """The numbers that the inputs select. Skills, transforms and parameters have no messages."""
    for each in inputs:
        channel = Channel(each.topic, each.message_type)
        if each.edge is None and each.query is None and not is_setting(channel):
            for path, kind, unit in _numbers_in(each.type):
                name = each.declaration.name.text
                yield _Number(channel, (*each.path, *path), kind, unit, name)


def _numbers_in(type_: Type) -> Iterator[tuple[FieldPath, FieldKind, str]]:
    """The path, the kind and the unit of each number; arrays, lists and headers are left out."""
    match type_:
        case Boolean():
            yield (), FieldKind.FLAG, ""
        case Quantity(unit=unit):
            yield (), FieldKind.REAL, "" if unit is None else unit.symbol
        case Vector(element=element):
            for axis in AXES:
                yield from _below(axis, element)
        case Quaternion():
            for axis in (*AXES, "w"):
                yield from _below(axis, Quantity(None))
        case Message(name=name, fields=fields):
            for part, inner in fields.items() if name != _HEADER else ():
                yield from _below(part, inner)
        case (
            Text() | Array() | List() | Interval() | Box() | Region() | Motion() | Entry()
            | Unsupported() | Unknown()
        ):  # fmt: skip
            return


def _below(part: str, inner: Type) -> Iterator[tuple[FieldPath, FieldKind, str]]:
    for path, kind, unit in _numbers_in(inner):
        yield (part, *path), kind, unit


def _machine(numbers: Sequence[_Number]) -> Machine:
    """A machine without rules that reads the numbers."""
    channels = list(dict.fromkeys(each.channel for each in numbers))
    readers = list(dict.fromkeys((each.name, each.channel) for each in numbers))
    nowhere = Span(SourceFile("recorded", ""), 0, 0)
    inputs = tuple(Input(name, channels.index(channel), None, nowhere) for name, channel in readers)
    slots = tuple(
        Slot(readers.index((each.name, each.channel)), each.path, each.kind, 1.0, 0.0, each.unit)
        for each in numbers
    )
    return Machine("recorded", tuple(channels), inputs, slots, (), (), (), (), ())
