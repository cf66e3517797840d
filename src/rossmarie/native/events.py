"""Events in the log of the C code, converted to events of `ir`."""

from __future__ import annotations

import struct

from rossmarie import ir
from rossmarie.ir import Change, Event, InputState, TimeJump, TruthValue, Verdict

_TIME_JUMP = 3

_TRUTH_VALUES = tuple(TruthValue)
_STATES = tuple(InputState)
_CHANGES = tuple(Change)


class EventReader:
    """Reads the events of one machine from the bytes of its log."""

    def __init__(self, machine: ir.Machine) -> None:
        self._rules = machine.rules
        self._terms = max([1, *(len(rule.terms) for rule in machine.rules)])
        self._values = max([1, *(len(rule.signals) for rule in machine.rules)])
        self._inputs = max([1, *(len(rule.inputs) for rule in machine.rules)])
        layout = f"2q{self._terms}q{self._values}d2i{self._terms}B{self._inputs}B"
        # The trailing 0q pads to the alignment of the struct.
        self._struct = struct.Struct(f"@{layout}0q")

    @property
    def size(self) -> int:
        """The size of one logged event in bytes."""
        return self._struct.size

    def read(self, log: bytes) -> list[Event]:
        """All events of a log."""
        return [self._event(fields) for fields in self._struct.iter_unpack(log)]

    def _event(self, fields: tuple[int | float, ...]) -> Event:
        at_ns, from_ns = int(fields[0]), int(fields[1])
        values_at = 2 + self._terms
        rule_at = values_at + self._values
        index, change = int(fields[rule_at]), int(fields[rule_at + 1])
        if change == _TIME_JUMP:
            return TimeJump(from_ns, at_ns)
        rule = self._rules[index]
        truth_values_at = rule_at + 2
        inputs_at = truth_values_at + self._terms
        terms = len(rule.terms)
        return Verdict(
            rule=index,
            at_ns=at_ns,
            change=_CHANGES[change],
            truth_values=tuple(
                _TRUTH_VALUES[int(x)] for x in fields[truth_values_at : truth_values_at + terms]
            ),
            since_ns=tuple(int(x) for x in fields[2 : 2 + terms]),
            values=tuple(float(x) for x in fields[values_at : values_at + len(rule.signals)]),
            inputs=tuple(_STATES[int(x)] for x in fields[inputs_at : inputs_at + len(rule.inputs)]),
        )
