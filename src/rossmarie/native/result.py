"""The results of a run over many rows, computed on demand."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rossmarie import ir
from rossmarie.ir import Event
from rossmarie.native.events import EventReader


@dataclass(eq=False)
class RunResult:
    """The results of a run over many rows.

    `packed_active` has a row of bytes for every row of the run. The bit of rule r is bit `r % 8` of
    byte `r // 8`. It is None if the run did not record it.
    """

    machine: ir.Machine
    reader: EventReader
    log: bytes
    packed_active: NDArray[np.uint8] | None

    @cached_property
    def events(self) -> list[Event]:
        """All events, in order."""
        return self.reader.read(self.log)

    @cached_property
    def active(self) -> NDArray[np.bool_]:
        """The rules that were active after each row, of shape (rows, rules).

        Raises `ValueError` if the run did not record them.
        """
        if self.packed_active is None:
            raise ValueError("run with active=True to learn which rules were active")
        rules = len(self.machine.rules)
        bits = np.unpackbits(self.packed_active, axis=1, count=rules, bitorder="little")
        return bits.view(np.bool_)
