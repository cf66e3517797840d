"""A monitor that takes updates in batches, and the same by the interpreter, one by one."""

from __future__ import annotations

import struct
from collections.abc import Sequence

from rossmarie import ir
from rossmarie.interpreter import Interpreter
from rossmarie.native import NativeMonitor
from rossmarie.recordings.batches import batched
from rossmarie.recordings.model import Update
from support import machines
from support.machines import Step, exactly

Observed = tuple[list[object], list[tuple[int, list[str]]]]
"""Events, and samples: instants with the bits of the values."""


def can_be_shown(machine: ir.Machine) -> tuple[int, ...]:
    """The signals of which there can be samples."""
    elements = ir.element_arrays(machine).signals
    return tuple(
        index
        for index, signal in enumerate(machine.signals)
        if elements[index] is None and not isinstance(signal.node, ir.Constant)
    )


def in_batches(
    machine: ir.Machine, monitor: NativeMonitor, trace: Sequence[Step], size: int
) -> Observed:
    """The findings of a monitor for the updates of a trace, taken in batches of some size."""
    updates = updates_of(trace)
    events, samples = list[object](), list[tuple[int, list[str]]]()
    for start in range(0, len(updates), size):
        (batch,) = batched(machine, updates[start : start + size])
        taken = monitor.take(batch, can_be_shown(machine))
        events += map(exactly, taken.events)
        rows = zip(taken.times_ns.tolist(), taken.values.tolist(), strict=True)
        samples += [(at_ns, bits_of(values)) for at_ns, values in rows]
    return events, samples


def one_by_one(machine: ir.Machine, trace: Sequence[Step]) -> Observed:
    """The same by the interpreter, with a sample of all that can be shown wherever it evaluates."""
    interpreter = Interpreter(machine)
    shown = can_be_shown(machine)
    events, samples = list[ir.Event](), list[tuple[int, list[str]]]()

    def sample(at_ns: int) -> None:
        values = interpreter.signals
        samples.append((at_ns, bits_of([values[signal] for signal in shown])))

    for update in updates_of(trace):
        while (wake_ns := interpreter.next_wake()) is not None and wake_ns < update.at_ns:
            events += interpreter.advance(wake_ns)
            sample(wake_ns)
        events += interpreter.update(update.at_ns, update.channels)
        sample(update.at_ns)
    return [exactly(event) for event in events], samples


def updates_of(trace: Sequence[Step]) -> list[Update]:
    """The updates of a trace."""
    return [
        Update(step.at_ns, step.messages) for step in trace if isinstance(step, machines.Update)
    ]


def bits_of(values: Sequence[float]) -> list[str]:
    """Numbers that equal others only if all bits do; any NaN is like any other."""
    return ["nan" if value != value else struct.pack("<d", value).hex() for value in values]
