"""When anything can change by itself (rule S15)."""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie import ir
from rossmarie.interpreter.memory import Memory
from rossmarie.ir import InputState, TruthValue


def next_wake(machine: ir.Machine, memory: Memory) -> int | None:
    """The earliest instant after the last evaluation at which a timer is due."""
    return min((*_expiries(machine, memory), *_timers(machine, memory)), default=None)


def _expiries(machine: ir.Machine, memory: Memory) -> Iterator[int]:
    for declared, present in zip(machine.inputs, memory.inputs, strict=True):
        if present.state is InputState.FRESH and declared.timeout_ns is not None:
            yield present.stamp_ns + declared.timeout_ns


def _timers(machine: ir.Machine, memory: Memory) -> Iterator[int]:
    for index, truth in enumerate(machine.truths):
        match truth.node, memory.truths[index]:
            case ir.Held(duration_ns=duration_ns), value if value is not TruthValue.TRUE:
                if (start_ns := memory.held[index].start_ns) is not None:
                    yield start_ns + duration_ns
            case ir.AgeReaches(input=used, age_ns=age_ns), TruthValue.FALSE:
                yield memory.inputs[used].stamp_ns + age_ns
            case ir.Oscillates(window_ns=window_ns), TruthValue.TRUE:
                oldest_ns = memory.oscillations[index].oldest_ns()
                assert oldest_ns is not None, "a true oscillation has all its turning points"
                yield oldest_ns + window_ns
            case ir.Oscillates(window_ns=window_ns), TruthValue.UNKNOWN | TruthValue.LOST:
                if (gap_end_ns := memory.oscillations[index].gap_end_ns) is not None:
                    yield gap_end_ns + window_ns
            case _:
                pass
