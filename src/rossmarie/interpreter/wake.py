"""The next instant at which a value can change without a message (rule S15)."""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie import ir
from rossmarie.interpreter.memory import MachineMemory, Recent
from rossmarie.ir import InputState, TruthValue


def next_wake(machine: ir.Machine, memory: MachineMemory) -> int | None:
    """The earliest instant after the last evaluation at which a timer is due."""
    return min((*_expiries(machine, memory), *_timers(machine, memory)), default=None)


def _expiries(machine: ir.Machine, memory: MachineMemory) -> Iterator[int]:
    for declared, present in zip(machine.inputs, memory.inputs, strict=True):
        if present.state is InputState.FRESH and declared.timeout_ns is not None:
            yield present.stamp_ns + declared.timeout_ns


def _timers(machine: ir.Machine, memory: MachineMemory) -> Iterator[int]:
    for index, proposition in enumerate(machine.propositions):
        value = memory.truth_values[index]
        match proposition.node:
            case ir.Held(duration_ns=duration_ns) if value is not TruthValue.TRUE:
                if (start_ns := memory.held[index].start_ns) is not None:
                    yield start_ns + duration_ns
            case ir.AgeReaches(input=used, age_ns=age_ns) if value is TruthValue.FALSE:
                yield memory.inputs[used].stamp_ns + age_ns
            case ir.Oscillates(window_ns=window_ns):
                since_ns = _window_since_ns(memory.oscillations[index].recent, value)
                if since_ns is not None:
                    yield since_ns + window_ns
            case ir.Recurs(window_ns=window_ns):
                since_ns = _window_since_ns(memory.recurrences[index].recent, value)
                if since_ns is not None:
                    yield since_ns + window_ns
            case (
                ir.Literal() | ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches()
                | ir.Quantified() | ir.Not() | ir.And() | ir.Or() | ir.Held() | ir.Since()
            ):  # fmt: skip
                pass


def _window_since_ns(recent: Recent, value: TruthValue | None) -> int | None:
    """The beginning in ns of the window at whose end a proposition changes; None if it does not
    change.
    """
    match value:
        case TruthValue.TRUE:
            oldest_ns = recent.oldest_ns()
            assert oldest_ns is not None, "what is true has all its turning points or edges"
            return oldest_ns
        case TruthValue.UNKNOWN | TruthValue.STALE:
            return recent.gap_end_ns
        case TruthValue.FALSE | None:
            return None
