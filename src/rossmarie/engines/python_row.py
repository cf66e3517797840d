"""Guards in a row, in Python. This is the counterpart of `native`'s row."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rossmarie import ir
from rossmarie.engines.python_steps import PythonSteps
from rossmarie.native import CHANGED


class Steered(Protocol):
    """The interface of a guard in the row."""

    @property
    def now_ns(self) -> int:
        """The current instant in ns; before the first call, an instant out of range."""

    @property
    def active(self) -> Sequence[bool]:
        """The rules that are active."""

    @property
    def margins(self) -> tuple[float, ...]:
        """The margins that rules declare, in SI units."""

    def take(self) -> ir.Reported:
        """All events and task commands since the last call."""

    def take_events(self) -> list[ir.Event]:
        """The events since the last call. Task commands stay."""

    def restart(self) -> None:
        """Forget everything."""

    def steps(self, wiring: ir.Wiring) -> PythonSteps:
        """Steps for arrays of the sizes in a wiring."""


class PythonRow:
    """Guards in a row. One call performs a step of all guards."""

    def __init__(self, guards: Sequence[Steered]) -> None:
        self._guards = guards
        self._steps: list[PythonSteps] = []

    def connect(self, wiring: ir.Wiring) -> None:
        """Use arrays of the sizes in a wiring from now on."""
        self._steps = [guard.steps(wiring) for guard in self._guards]

    def step(
        self,
        which: NDArray[np.bool_] | None,
        times_ns: NDArray[np.int64] | None,
        observations: NDArray[np.float64] | None,
        actions: NDArray[np.float64] | None,
    ) -> tuple[int, NDArray[np.bool_], NDArray[np.bool_]]:
        """Perform a step of all guards, like `NativeRow.step`."""
        count = len(self._guards)
        active = np.empty((count, len(self._guards[0].active)), np.bool_)
        changed = np.zeros(count, np.bool_)
        marked = range(count) if which is None else np.flatnonzero(which).tolist()
        instants = {row: self._instant(row, times_ns) for row in marked}
        for row, at_ns in instants.items():
            if at_ns is None:
                return row, active, changed
        for row, at_ns in instants.items():
            assert at_ns is not None
            seen = None if observations is None else observations[row]
            note = self._steps[row].step(at_ns, seen, None if actions is None else actions[row])
            assert note is not None
            self._guards[row].take_events()
            if actions is not None:
                self._guards[row].take()
            changed[row] = bool(note[0] & CHANGED)
        for row, guard in enumerate(self._guards):
            active[row] = guard.active
        return count, active, changed

    def _instant(self, row: int, times_ns: NDArray[np.int64] | None) -> int | None:
        """The instant of a row; None if it is out of range or not known yet."""
        now_ns = self._guards[row].now_ns
        if times_ns is None:
            return None if now_ns == ir.EARLIEST_NS else now_ns
        at_ns = int(times_ns[row if len(times_ns) > 1 else 0])
        can_be = ir.EARLIEST_NS < at_ns < ir.LATEST_NS and at_ns >= now_ns
        return at_ns if can_be else None

    def allow(self, actions: NDArray[np.float64]) -> tuple[int, NDArray[np.bool_]]:
        """Say which actions would pass unchanged, like `NativeRow.allow`."""
        allowed = np.empty((len(self._guards), len(actions)), np.bool_)
        for row, guard in enumerate(self._guards):
            if guard.now_ns == ir.EARLIEST_NS:
                return row, allowed
            allowed[row] = [self._steps[row].allows(each) for each in actions]
        return len(self._guards), allowed

    def margins(self) -> NDArray[np.float64]:
        """The margins of all guards, like `NativeRow.margins`."""
        found = [guard.margins for guard in self._guards]
        return np.array(found, np.float64)

    def restart(self, which: NDArray[np.bool_]) -> None:
        """Let the marked guards forget everything."""
        for guard, is_marked in zip(self._guards, which.tolist(), strict=True):
            if is_marked:
                guard.restart()
