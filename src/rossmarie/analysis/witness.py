"""A witness: a short trace that shows a finding.

Reports describe a witness in the terms of the rules file, and a witness can be written as a
recording.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, FieldKind, Machine, TruthValue, kind_of, path_text
from rossmarie.ir.duration_text import duration_text

SECOND = 1_000_000_000
_MOST_ARRIVALS = 6
_MOST_REPORTED = 12


@dataclass(frozen=True)
class Sending:
    """Messages that arrive at one instant, in ns, by channel; numbers are raw, as in
    `ChannelValues`.
    """

    at_ns: int
    messages: Mapping[int, ChannelValues]


@dataclass(frozen=True)
class Witness:
    """Messages in the order in which they arrive, and the instant of the last evaluation. `is_calm`
    is True if all relevant sensors work.
    """

    events: tuple[Sending, ...]
    end_ns: int
    is_calm: bool


@dataclass(frozen=True)
class View:
    """The result of an evaluation: active rules and queried propositions, by index, and signals."""

    at_ns: int
    active: tuple[bool, ...]
    truth_values: Mapping[int, TruthValue]
    signals: tuple[float, ...]


Predicate = Callable[[Sequence[View]], bool]
"""A test of the views up to the last one; True if they show the finding."""


def within(machine: Machine, witness: Witness) -> Witness:
    """The witness for a machine, cut from a witness for a machine with more channels at the end."""
    slots, arrays = len(machine.slots), len(machine.arrays)

    def kept(values: ChannelValues) -> ChannelValues:
        return ChannelValues(
            {index: value for index, value in values.slots.items() if index < slots},
            {index: value for index, value in values.arrays.items() if index < arrays},
        )

    events = (
        replace(
            sending,
            messages={
                channel: kept(values)
                for channel, values in sending.messages.items()
                if channel < len(machine.channels)
            },
        )
        for sending in witness.events
    )
    return replace(witness, events=tuple(events))


def views(machine: Machine, witness: Witness, asked: Sequence[int] = ()) -> Iterator[View]:
    """The evaluations of a witness, with the values of some propositions."""
    watching = replace(machine, watches=tuple(asked))
    monitor = Interpreter(watching)

    def seen(at_ns: int) -> View:
        propositions = dict(zip(asked, monitor.watches, strict=True))
        return View(at_ns, monitor.active, propositions, monitor.signals)

    for sending in witness.events:
        while (wake_ns := monitor.next_wake()) is not None and wake_ns < sending.at_ns:
            monitor.advance(wake_ns)
            yield seen(wake_ns)
        monitor.update(sending.at_ns, sending.messages)
        yield seen(sending.at_ns)
    while (wake_ns := monitor.next_wake()) is not None and wake_ns <= witness.end_ns:
        monitor.advance(wake_ns)
        yield seen(wake_ns)
    if not witness.events:
        monitor.advance(witness.end_ns)
        yield seen(witness.end_ns)


def as_csv(machine: Machine, witness: Witness) -> str:
    """The witness as a recording that `rossmarie replay` reads. Numbers are written without
    loss.
    """
    channels = sorted({channel for event in witness.events for channel in event.messages})
    if not channels:  # a recording also contains the silent topics
        channels = list(range(len(machine.channels)))
    columns = [column for channel in channels for column in _columns(machine, channel, witness)]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["time_ns", *(column.name for column in columns)])
    for event in witness.events:
        writer.writerow([event.at_ns, *(column.cell(machine, event) for column in columns)])
    if not witness.events or witness.end_ns > witness.events[-1].at_ns:
        writer.writerow([witness.end_ns, *("" for _ in columns)])
    return text.getvalue()


@dataclass(frozen=True)
class _Column:
    """A column of a recording: a slot, or with `element` one element of an array. Without an
    `index`, the column marks the arrival of a message.
    """

    name: str
    channel: int
    index: int | None
    element: int | None = None

    def cell(self, machine: Machine, event: Sending) -> str:
        """The text of this column in the row of an event."""
        values = event.messages.get(self.channel)
        if values is None:
            return ""
        if self.index is None:
            return "1"
        if self.element is not None:
            elements = values.arrays.get(self.index, ())
            return repr(elements[self.element]) if self.element < len(elements) else ""
        raw = values.slots.get(self.index, math.nan)
        kind = machine.slots[self.index].kind
        if math.isnan(raw):
            return "nan" if kind is FieldKind.REAL else ""
        match kind:
            case FieldKind.FLAG:
                return str(raw != 0.0).lower()
            case FieldKind.TEXT:
                return machine.texts[int(raw)] if raw >= 0.0 else other_text(machine)
            case FieldKind.REAL:
                return repr(raw)


def other_text(machine: Machine) -> str:
    """A text that does not occur in the rules."""
    text = "another"
    while text in machine.texts:
        text += "_"
    return text


def _columns(machine: Machine, channel: int, witness: Witness) -> Iterator[_Column]:
    fields = list(_fields(machine, channel, witness))
    sent = [event for event in witness.events if channel in event.messages]
    if not fields or not all(any(column.cell(machine, each) for column in fields) for each in sent):
        yield _Column(machine.channels[channel].topic, channel, None)
    yield from fields


def _fields(machine: Machine, channel: int, witness: Witness) -> Iterator[_Column]:
    topic = machine.channels[channel].topic
    for index, slot in enumerate(machine.slots):
        if machine.inputs[slot.input].channel == channel:
            yield _Column(f"{topic}{path_text(slot.path)}", channel, index)
    for index, array in enumerate(machine.arrays):
        if machine.inputs[array.input].channel == channel and array.list is None:
            for element in range(_longest(witness, channel, index)):
                name = f"{topic}{path_text((*array.path, element))}"
                yield _Column(name, channel, index, element)


def _longest(witness: Witness, channel: int, array: int) -> int:
    found = (event.messages.get(channel) for event in witness.events)
    return max((len(values.arrays.get(array, ())) for values in found if values), default=1) or 1


# --- words -----------------------------------------------------------------------------------


def reported(machine: Machine, witness: Witness, signals: Sequence[int]) -> str:
    """Describe a witness on one line: the measured values with their instants, and the silent
    topics.

    `signals` are the indices of the signals to describe.
    """
    if not witness.events:
        return "before any message"
    if not signals:
        return "; ".join([*_arrivals(machine, witness), f"until {duration_text(witness.end_ns)}"])
    parts = []
    before: list[str] | None = None
    for view in views(machine, witness):
        now = list(dict.fromkeys(_shown(machine, index, view) for index in signals))
        if now != before:
            parts.append(f"at {duration_text(view.at_ns)} {', '.join(now)}")
        before = now
    ends = duration_text(witness.end_ns)
    if len(parts) > _MOST_REPORTED:
        parts = [*parts[:_MOST_REPORTED], "and so on"]
    return "; ".join(parts) + (f"; until {ends}" if witness.end_ns else "")


def _arrivals(machine: Machine, witness: Witness) -> Iterator[str]:
    """The arrivals of messages, if no value is measured: instants and topics. Of many equal
    arrivals, only the first are given.
    """
    is_long = len(witness.events) > _MOST_ARRIVALS
    before: frozenset[int] = frozenset()
    for event in witness.events:
        channels = frozenset(event.messages)
        if channels != before or not is_long:
            topics = ", ".join(machine.channels[channel].topic for channel in sorted(channels))
            yield f"at {duration_text(event.at_ns)} {topics}"
        before = channels


def _shown(machine: Machine, index: int, view: View) -> str:
    signal = machine.signals[index]
    text, value = signal.text, view.signals[index]
    return f"{text} = {shown_value(machine, index, value)}"


def shown_value(machine: Machine, index: int, value: float) -> str:
    """A value of a signal in the user's notation: `20 deg`, `true`, `"docked"`, `unknown`."""
    signal = machine.signals[index]
    if math.isnan(value):
        return "unknown"
    match kind_of(machine, index):
        case FieldKind.FLAG:
            return str(value != 0.0).lower()
        case FieldKind.TEXT:
            return f'"{machine.texts[int(value)]}"' if value >= 0.0 else "another string"
        case FieldKind.REAL:
            return f"{value * signal.scale + signal.offset:.6g} {signal.unit}".rstrip()
