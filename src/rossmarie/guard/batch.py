"""Guards of many environments. One call performs a step of all of them."""

from __future__ import annotations

from collections.abc import Callable
from threading import Lock
from typing import Any, NamedTuple, NoReturn

import numpy as np
from numpy.typing import NDArray

from rossmarie.engines import GuardRow
from rossmarie.guard.arrays import FLOATS
from rossmarie.guard.feedback import FeedbackMeter, rules_with_margin
from rossmarie.guard.mapping import MappingError
from rossmarie.ir import Machine, Wiring, require_instant
from rossmarie.native import put_back

Array = NDArray[Any]


class BatchDecision(NamedTuple):
    """The decisions: the actions to execute, of shape (n, m); the active rules, as a mask of shape
    (n, rules); and the changed actions, as a mask of shape (n,).
    """

    actions: Array
    active: NDArray[np.bool_]
    changed: NDArray[np.bool_]


class GuardBatch:
    """Guards of the same rules, each for its own environment. Requests of rules beside the action
    are not reported, and their ends cannot be reported. A batch cannot be copied. Calls from
    several threads wait for each other.
    """

    def __init__(
        self,
        count: int,
        machine: Machine,
        row_of: Callable[[int], GuardRow],
        wiring_of: Callable[[int, int | None], Wiring],
    ) -> None:
        """`row_of` creates the guards. `wiring_of` connects arrays of the sizes of an observation
        and of an action.
        """
        if count < 1:
            raise ValueError(f"a batch has at least one guard, not {count}")
        self.rules = tuple(rule.name for rule in machine.rules)
        self.rules_with_margin = rules_with_margin(machine)
        self._meter = FeedbackMeter(machine)
        self._count = count
        self._row = row_of(count)
        self._wiring_of = wiring_of
        self._sizes: tuple[int, int | None] | None = None
        self._lock = Lock()

    def __len__(self) -> int:
        """The number of guards."""
        return self._count

    def __reduce__(self) -> NoReturn:
        """Refuse `copy`, `deepcopy` and `pickle`, because the copy would share the state of the
        guards.
        """
        raise TypeError(
            "a batch of guards cannot be copied or pickled: make another with `guard.batch(n)`"
        )

    @property
    def margin(self) -> NDArray[np.float64]:
        """The margins in each environment at its last observation, of shape (n, margins), as in
        `Decision.margin`; NaN before the first observation.
        """
        with self._lock:
            return self._meter.margins(self._row.margins())

    def step(
        self, times_ns: int | NDArray[np.int64], observations: Array, actions: Array
    ) -> BatchDecision:
        """Decide about an action in each environment. `times_ns` is one instant, or int64 of shape
        (n,); observations have the shape (n, k), actions (n, m).

        Raises `MappingError` for arrays of another shape or type, `ValueError` for an instant out
        of range or before the last instant of its guard. After an error no guard has changed.
        """
        self._connect(observations, actions)
        numbers = np.array(actions, np.float64, order="C")
        active, changed = self._step(None, self._times(times_ns), observations, numbers)
        return BatchDecision(_of_type(numbers, actions), active, changed)

    def observe(
        self,
        times_ns: int | NDArray[np.int64],
        observations: Array,
        which: NDArray[np.bool_] | None = None,
    ) -> NDArray[np.bool_]:
        """Process an observation in each environment, or in the environments that a mask of shape
        (n,) marks, for `decide`. Returns a mask of the active rules, of shape (n, rules).

        Raises the errors of `step`.
        """
        self._connect(observations, None)
        return self._step(self._mask(which), self._times(times_ns), observations, None)[0]

    def decide(self, actions: Array, which: NDArray[np.bool_] | None = None) -> BatchDecision:
        """Decide about an action in each environment, or in the environments that a mask marks, at
        the instants of their last observations. Raises the errors of `step`, and `ValueError` for a
        guard without an observation.
        """
        self._connect(None, actions)
        numbers = np.array(actions, np.float64, order="C")
        active, changed = self._step(self._mask(which), None, None, numbers)
        return BatchDecision(_of_type(numbers, actions), active, changed)

    def allows(self, actions: Array) -> NDArray[np.bool_]:
        """For actions of shape (k, m), whether each would pass unchanged in each environment, as a
        mask of shape (n, k). Changes nothing. Raises the errors of `decide`.
        """
        with self._lock:
            self._connect(None, actions, "k")
            done, allowed = self._row.allow(np.ascontiguousarray(actions, np.float64))
        self._require_observed(done)
        return allowed

    def _step(
        self,
        which: NDArray[np.bool_] | None,
        times: NDArray[np.int64] | None,
        observations: Array | None,
        numbers: Array | None,
    ) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        seen = None if observations is None else np.ascontiguousarray(observations, np.float64)
        with self._lock:
            done, active, changed = self._row.step(which, times, seen, numbers)
        if times is None:
            self._require_observed(done)
        elif done != self._count:
            at_ns = int(times[done if len(times) > 1 else 0])
            require_instant(at_ns)
            raise ValueError(
                f"time goes back to {at_ns} ns in row {done}; call `restart` before a new episode"
            )
        return active, changed

    def _require_observed(self, done: int) -> None:
        if done != self._count:
            raise ValueError(f"row {done} has no observation yet: call `observe` first")

    def _connect(
        self, observations: Array | None, actions: Array | None, rows: str | None = None
    ) -> None:
        """Connect the arrays when their sizes are known. Raises `MappingError` if they do not
        fit.
        """
        observed, acted = self._sizes or (None, None)
        given = (
            None if observations is None else self._width("observations", observations),
            None if actions is None else self._width("actions", actions, rows),
        )
        sizes = (given[0] if observed is None else observed, given[1] if acted is None else acted)
        for what, width, size in zip(("observations", "actions"), given, sizes, strict=True):
            if width not in (None, size):
                raise MappingError(f"{what} have {width} numbers, but had {size} at first")
        if sizes[0] is None:
            raise ValueError("there is no observation yet: call `observe` first")
        if self._sizes != sizes:
            self._row.connect(self._wiring_of(sizes[0], sizes[1]))
            self._sizes = (sizes[0], sizes[1])

    def restart(self, which: NDArray[np.bool_] | None = None) -> None:
        """Forget everything, in all environments or in the environments that a mask of shape (n,)
        marks.
        """
        mask = self._mask(which)
        with self._lock:
            self._row.restart(np.ones(self._count, np.bool_) if mask is None else mask)

    def _mask(self, which: NDArray[np.bool_] | None) -> NDArray[np.bool_] | None:
        if which is None:
            return None
        mask = np.asarray(which)
        if mask.shape != (self._count,) or mask.dtype != np.bool_:
            raise MappingError(f"a mask needs the type bool and the shape ({self._count},)")
        return np.ascontiguousarray(mask)

    def _times(self, times_ns: int | NDArray[np.int64]) -> NDArray[np.int64]:
        times = np.atleast_1d(np.asarray(times_ns))
        if times.dtype != np.int64 or times.shape not in ((1,), (self._count,)):
            raise MappingError(
                f"instants are one int64 or ({self._count},) of them, "
                f"not {times.dtype} of shape {np.shape(times_ns)}"
            )
        return np.ascontiguousarray(times)

    def _width(self, what: str, rows: Array, length: str | None = None) -> int:
        """The number of values in a row. There are `length` rows, or as many as guards."""
        if not isinstance(rows, np.ndarray):
            raise TypeError(f"{what} are a {type(rows).__name__}, not a NumPy array")
        if rows.ndim != 2 or (length is None and len(rows) != self._count):
            raise MappingError(
                f"{what} have the shape {rows.shape}, not ({length or self._count}, ...)"
            )
        if rows.dtype not in FLOATS:
            raise MappingError(f"{what} hold {rows.dtype}, not float64 or float32")
        return int(rows.shape[1])


def _of_type(numbers: Array, actions: Array) -> Array:
    """Numbers as actions. They get the type of the proposed actions."""
    if actions.dtype == np.float64:
        return numbers
    executed = np.array(actions, order="C")
    put_back(numbers, executed)
    return executed
