"""Guards in a row, in Python: as `native`'s."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rossmarie import ir
from rossmarie.native import CHANGED, StepCall


class Steered(Protocol):
    """A guard in the row."""

    @property
    def now_ns(self) -> int:
        """The instant at which it is; before the first, one that is out of range."""

    @property
    def active(self) -> Sequence[bool]:
        """The rules that are active."""

    def take(self) -> ir.Told:
        """All that was told since the last time."""

    def restart(self) -> None:
        """Forget everything."""

    def step_call(self, wiring: ir.Wiring) -> StepCall:
        """The fastest step."""


class PythonRow:
    """Guards in a row: a step of all of them is one call."""

    def __init__(self, guards: Sequence[Steered], wiring: ir.Wiring) -> None:
        self._guards = guards
        self._steps = [guard.step_call(wiring) for guard in guards]

    def step(
        self,
        times_ns: NDArray[np.int64],
        observations: NDArray[np.float64],
        actions: NDArray[np.float64],
    ) -> tuple[int, NDArray[np.bool_], NDArray[np.bool_]]:
        """As `NativeRow.step`."""
        times = np.broadcast_to(times_ns, len(self._guards)).tolist()
        active = np.empty((len(self._guards), len(self._guards[0].active)), np.bool_)
        changed = np.empty(len(self._guards), np.bool_)
        for row, (guard, at_ns) in enumerate(zip(self._guards, times, strict=True)):
            if not ir.EARLIEST_NS < at_ns < ir.LATEST_NS or at_ns < guard.now_ns:
                return row, active, changed
        for row, (guard, at_ns) in enumerate(zip(self._guards, times, strict=True)):
            note = self._steps[row](at_ns, observations[row], actions[row])
            assert note is not None
            guard.take()
            active[row] = guard.active
            changed[row] = bool(note[0] & CHANGED)
        return len(self._guards), active, changed

    def restart(self, which: NDArray[np.bool_]) -> None:
        """Let those that are marked forget everything."""
        for guard, is_marked in zip(self._guards, which.tolist(), strict=True):
            if is_marked:
                guard.restart()
