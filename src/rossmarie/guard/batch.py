"""Guards of many environments: a step of all of them is one call."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rossmarie.engines import GuardRow
from rossmarie.guard.mapping import MappingError
from rossmarie.ir import require_instant
from rossmarie.native import put_back

Array = NDArray[Any]
_FLOATS = (np.float64, np.float32)


class BatchDecision(NamedTuple):
    """The decisions: the actions to execute, of shape (n, m); which rules are active, of shape
    (n, rules); and which actions are not those that were wanted, of shape (n,).
    """

    actions: Array
    active: NDArray[np.bool_]
    changed: NDArray[np.bool_]


class GuardBatch:
    """So many guards of the same rules, each for an environment of its own. What rules want done
    beside the action is not told, and nobody reports how it ended.
    """

    def __init__(
        self, count: int, rules: tuple[str, ...], row_of: Callable[[int, int], GuardRow]
    ) -> None:
        """`row_of` makes the guards for the sizes of an observation and of an action."""
        if count < 1:
            raise ValueError(f"a batch has at least one guard, not {count}")
        self.rules = rules
        self._count = count
        self._row_of = row_of
        self._row: GuardRow | None = None
        self._sizes: tuple[int, int] | None = None

    def __len__(self) -> int:
        """The number of guards."""
        return self._count

    def step(
        self, times_ns: int | NDArray[np.int64], observations: Array, actions: Array
    ) -> BatchDecision:
        """Decide about an action in each environment: `times_ns` is one instant, or int64 of shape
        (n,); observations have the shape (n, k), actions (n, m).

        Raises `MappingError` for arrays of another shape or type, `ValueError` for an instant
        before the last one of its guard or out of range: then nothing has happened to any.
        """
        times = self._times(times_ns)
        sizes = self._width("observations", observations), self._width("actions", actions)
        if self._sizes not in (None, sizes):
            raise MappingError(
                f"observations and actions have {sizes} numbers, but had {self._sizes} at first"
            )
        if self._row is None:
            self._row, self._sizes = self._row_of(*sizes), sizes
        numbers = np.array(actions, np.float64, order="C")
        seen = np.ascontiguousarray(observations, np.float64)
        done, active, changed = self._row.step(times, seen, numbers)
        if done != self._count:
            at_ns = int(times[done if len(times) > 1 else 0])
            require_instant(at_ns)
            raise ValueError(
                f"time goes back to {at_ns} ns in row {done}; call `restart` before a new episode"
            )
        if actions.dtype == np.float64:
            return BatchDecision(numbers, active, changed)
        executed = np.array(actions, order="C")
        put_back(numbers, executed)
        return BatchDecision(executed, active, changed)

    def restart(self, which: NDArray[np.bool_] | None = None) -> None:
        """Forget everything, in all environments or in those that a mask of shape (n,) marks."""
        mask = np.ones(self._count, np.bool_) if which is None else np.asarray(which)
        if mask.shape != (self._count,) or mask.dtype != np.bool_:
            raise MappingError(f"a mask is bool of shape ({self._count},)")
        if self._row is not None:
            self._row.restart(np.ascontiguousarray(mask))

    def _times(self, times_ns: int | NDArray[np.int64]) -> NDArray[np.int64]:
        times = np.atleast_1d(np.asarray(times_ns))
        if times.dtype != np.int64 or times.shape not in ((1,), (self._count,)):
            raise MappingError(
                f"instants are one int64 or ({self._count},) of them, "
                f"not {times.dtype} of shape {np.shape(times_ns)}"
            )
        return np.ascontiguousarray(times)

    def _width(self, what: str, rows: Array) -> int:
        if not isinstance(rows, np.ndarray):
            raise TypeError(f"{what} are a {type(rows).__name__}, not an array of numpy")
        if rows.ndim != 2 or len(rows) != self._count:
            raise MappingError(f"{what} have the shape {rows.shape}, not ({self._count}, ...)")
        if rows.dtype not in _FLOATS:
            raise MappingError(f"{what} hold {rows.dtype}, not float64 or float32")
        return int(rows.shape[1])
