"""Random machines and random traces, to compare whatever runs a machine with the interpreter.

    @given(cases())
    def test_same(case: Case) -> None:
        machine, trace = case
        assert observe(Interpreter(machine), trace) == observe(other(machine), trace)

Durations and instants are small multiples of one tick, so that timers often fall due together and
at the instant of a message; numbers come from a small pool, so that comparisons often just hold.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from hypothesis import strategies as st

from rossmarie import ir
from support.drafts import SECOND
from support.growing import EXTREMES, NUMBERS, TICK, Growing
from support.skill_contexts import CONTEXTS, reported

NAN = float("nan")
INFINITY = float("inf")


# --- machines --------------------------------------------------------------------------------


@st.composite
def machines(draw: st.DrawFn, max_nodes: int = 14) -> ir.Machine:
    """A machine that `ir.verify` passes, with every kind of node and of contract."""
    growing = Growing(draw)
    growing.inputs()
    for _ in range(draw(st.integers(1, max_nodes))):
        growing.signal()
    for _ in range(draw(st.integers(1, max_nodes))):
        growing.proposition()
    for _ in range(draw(st.integers(1, 3))):
        growing.rule()
    watches = draw(st.lists(st.sampled_from(growing.propositions), max_size=2))
    return replace(growing.draft.machine("random"), watches=tuple(watches))


# --- traces ----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Update:
    """Messages arrive."""

    at_ns: int
    messages: Mapping[int, ir.ChannelValues]


@dataclass(frozen=True)
class Advance:
    """Time passes."""

    at_ns: int


@dataclass(frozen=True)
class Reset:
    """An operator resets a rule, or all."""

    at_ns: int
    rule: int | None


Step = Update | Advance | Reset
Case = tuple[ir.Machine, list[Step]]


@st.composite
def traces(draw: st.DrawFn, machine: ir.Machine, max_steps: int = 24) -> list[Step]:
    """Traces of a monitor: gaps, equal instants, jumps back, silence, invalid numbers."""
    return [draw(_step(machine, at_ns)) for at_ns in draw(instants(max_steps))]


@st.composite
def calm_traces(draw: st.DrawFn, machine: ir.Machine, max_steps: int = 40) -> list[Step]:
    """The same with few different messages at short distances: most of them change nothing."""
    channels = range(len(machine.channels))
    known = [draw(st.lists(channel_values(machine, c), min_size=1, max_size=3)) for c in channels]
    steps: list[Step] = []
    at_ns = 0
    for _ in range(draw(st.integers(1, max_steps))):
        at_ns += draw(st.sampled_from((0, 1, 1, 1, 1, 1, 1, 8, 40, -3))) * (TICK // 8)
        if draw(st.integers(0, 15)) == 0:
            steps.append(draw(_step(machine, at_ns)))
        else:
            channel = draw(st.sampled_from(channels))
            steps.append(Update(at_ns, {channel: draw(st.sampled_from(known[channel]))}))
    return steps


@st.composite
def instants(draw: st.DrawFn, most: int, least: int = 1) -> list[int]:
    """One or more instants, now and then the same or an earlier one."""
    ticks = st.sampled_from((0, 0, 1, 1, 1, 2, 2, 3, 5, 9, 20, -4))
    odd = st.sampled_from((0, 0, 0, 0, 1, -1, TICK // 3))
    found = [draw(st.sampled_from((0, 17, SECOND, -3 * SECOND, 1_700_000_000 * SECOND)))]
    for _ in range(draw(st.integers(least - 1, most - 1))):
        found.append(found[-1] + draw(ticks) * TICK + draw(odd))
    return found


def _step(machine: ir.Machine, at_ns: int) -> st.SearchStrategy[Step]:
    updates = _messages(machine).map(lambda messages: Update(at_ns, messages))
    rules = st.one_of(st.none(), st.integers(0, len(machine.rules) - 1))
    others: st.SearchStrategy[Step] = st.one_of(
        st.just(Advance(at_ns)), rules.map(lambda rule: Reset(at_ns, rule))
    )
    return st.one_of(updates, updates, updates, others)


@st.composite
def _messages(draw: st.DrawFn, machine: ir.Machine) -> dict[int, ir.ChannelValues]:
    channels = st.integers(0, len(machine.channels) - 1)
    chosen = draw(st.lists(channels, min_size=1, max_size=2, unique=True))
    return {channel: draw(channel_values(machine, channel)) for channel in sorted(chosen)}


@st.composite
def channel_values(draw: st.DrawFn, machine: ir.Machine, channel: int) -> ir.ChannelValues:
    """One message with the arrays of its channel, and nearly always all its slots; on that of
    skills, what they answer.
    """
    if machine.channels[channel].message_type == "skill_context_msgs/SkillContext":
        return draw(_answers(machine, channel))
    return ir.ChannelValues(
        slots={
            index: draw(raw(slot.kind, slot.limits))
            for index, slot in enumerate(machine.slots)
            if machine.inputs[slot.input].channel == channel and draw(_IS_PRESENT)
        },
        arrays={
            index: draw(st.lists(raw(ir.FieldKind.REAL, array.limits), max_size=4))
            for index, array in enumerate(machine.arrays)
            if machine.inputs[array.input].channel == channel and array.list is None
        }
        | draw(columns(machine, channel)),
    )


@st.composite
def _answers(draw: st.DrawFn, machine: ir.Machine, channel: int) -> ir.ChannelValues:
    """Answers of skills that run; some are of another export, some too large."""
    number = draw(st.integers(0, len(CONTEXTS) - 1))
    slots = {
        index: reported(slot.path[0], number)
        for index, slot in enumerate(machine.slots)
        if machine.inputs[slot.input].channel == channel
        and isinstance(slot.path[0], ir.Doing | ir.Quantity)
    }
    return ir.ChannelValues(slots, {})


@st.composite
def columns(draw: st.DrawFn, machine: ir.Machine, channel: int) -> dict[int, list[float]]:
    """The columns of the lists of a channel: none to too many elements, and nearly always all."""
    found: dict[int, list[float]] = {}
    for index, each in enumerate(machine.lists):
        if machine.inputs[each.input].channel != channel:
            continue
        count = draw(st.integers(0, each.most + 1))
        for column in ir.columns_of(machine, index):
            array = machine.arrays[column]
            numbers = raw(array.kind, array.limits)
            if draw(_IS_PRESENT):
                found[column] = draw(st.lists(numbers, min_size=count, max_size=count))
    return found


_IS_PRESENT = st.sampled_from((True,) * 9 + (False,))


def raw(kind: ir.FieldKind, limits: tuple[float, float] | None = None) -> st.SearchStrategy[float]:
    """A number as a message carries it; NaN if it is lacking."""
    if limits is not None:
        whole = st.integers(*map(int, limits)).map(float)
        return st.one_of(st.sampled_from((*limits, NAN)), whole)
    match kind:
        case ir.FieldKind.FLAG:
            return st.sampled_from((0.0, 1.0, 0.0, 1.0, NAN))
        case ir.FieldKind.TEXT:
            return st.sampled_from((0.0, 1.0, -1.0, 0.0, 1.0, NAN))
        case ir.FieldKind.REAL:
            broken = st.sampled_from((NAN, INFINITY, -INFINITY, *EXTREMES))
            return st.one_of(
                st.sampled_from(NUMBERS),
                st.sampled_from(NUMBERS),
                st.sampled_from(NUMBERS),
                broken,
                st.floats(width=64),
            )


@st.composite
def cases(draw: st.DrawFn) -> Case:
    """A machine and what happens to it."""
    machine = draw(machines())
    return machine, draw(traces(machine))


# --- what can be seen ------------------------------------------------------------------------


class Monitor(Protocol):
    """A monitor that runs a machine."""

    def update(self, at_ns: int, messages: Mapping[int, ir.ChannelValues]) -> Sequence[ir.Event]:
        """Messages arrive."""

    def advance(self, at_ns: int) -> Sequence[ir.Event]:
        """Time passes."""

    def reset(self, at_ns: int, rule: int | None = None) -> Sequence[ir.Event]:
        """An operator resets."""

    def next_wake(self) -> int | None:
        """The next time at which a timer may change the state."""

    @property
    def active(self) -> tuple[bool, ...]:
        """The activity of each rule."""


@dataclass(frozen=True)
class Observation:
    """All that a step shows to the outside."""

    events: tuple[object, ...]
    next_wake: int | None
    active: tuple[bool, ...]


def observe(monitor: Monitor, trace: Sequence[Step]) -> list[Observation]:
    """Run a trace and note everything, numbers by their bits."""
    return [
        Observation(
            tuple(exactly(event) for event in take(monitor, step)),
            monitor.next_wake(),
            tuple(monitor.active),
        )
        for step in trace
    ]


def take(monitor: Monitor, step: Step) -> Sequence[ir.Event]:
    """Do one step."""
    match step:
        case Update(at_ns, messages):
            return monitor.update(at_ns, messages)
        case Advance(at_ns):
            return monitor.advance(at_ns)
        case Reset(at_ns, rule):
            return monitor.reset(at_ns, rule)


def exactly(event: ir.Event) -> object:
    """An event that equals another one only if all bits do; any NaN is like any other."""
    if isinstance(event, ir.TimeJump):
        return event
    values = tuple("nan" if x != x else struct.pack("<d", x).hex() for x in event.values)
    return (event.rule, event.at_ns, event.change, event.truth_values, event.since_ns, values,
            event.inputs)  # fmt: skip
