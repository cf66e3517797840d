"""Answers of the running skills, as facts: the combinations that are possible (S58).

Any number of skills may run at a time. So the machine receives the union of the answers that single
calls give.
"""

from __future__ import annotations

import z3

from rossmarie import ir
from rossmarie.ir.calls import query_at


class Calls:
    """The calls that run when one message is sent. `name` distinguishes their variables."""

    def __init__(self, machine: ir.Machine, name: str) -> None:
        self._machine = machine
        self._runs = [
            (call, z3.Bool(f"{name}.call{number}")) for number, call in enumerate(machine.calls)
        ]

    def facts(self, slot: ir.Slot, value: z3.ArithRef) -> list[z3.BoolRef]:
        """Say that a slot holds the answer of the running calls, if the slot is a query about
        skills.
        """
        step = query_at(slot.path)
        if step is None or not self._runs:
            return []
        yes = z3.Or([runs for call, runs in self._runs if call.answers(step)])
        return [(value == 1) == yes]
