"""Actions that are target positions, for rules that bound speeds.

A rule bounds the speed of a robot, and blocks it with a speed of 0. If an action is a target, the
guard checks the speed of the target: (target - last target) / period. So a limit on a speed limits
the steps of the target, and a block keeps the last target.

All functions work on one action, of shape (m,), and on the actions of many environments, of shape
(n, m).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from rossmarie.guard import Declared, MappingError, Place
from rossmarie.gym.observations import Array

Floats = NDArray[np.float64]


class ActionTargets:
    """The targets among the numbers of flat actions, and the last executed targets."""

    def __init__(self, targets: Mapping[str, int], act: Declared, period_ns: int) -> None:
        """`targets` maps names of `act` to the number of an observation with the present position.
        Raises `MappingError` for a name that is not a single number of an action.
        """
        self._seconds = period_ns / 1e9
        self._seen = list(targets.values())
        self._places = [_place(name, act) for name in targets]
        self._last: Floats = np.zeros(0)

    def reset(self, observations: Array, which: NDArray[np.bool_] | None = None) -> None:
        """Begin an episode at the present position, in all environments or in the marked ones."""
        seen = np.array(observations[..., self._seen], np.float64)
        if which is not None and self._last.shape == seen.shape:
            seen = np.where(which[:, None], seen, self._last)
        self._last = seen

    def speeds(self, flat: Array) -> Array:
        """Actions in which the speeds of targets replace the targets."""
        if not self._places:
            return flat
        moved = np.array(flat, np.float64)
        moved[..., self._places] = (moved[..., self._places] - self._last) / self._seconds
        return moved

    def back(self, flat: Array, speeds: Array, bounded: Array) -> Array:
        """The actions to execute. Bounded speeds become targets; rounding moves these only towards
        the last targets.
        """
        if not self._places:
            return bounded
        executed = np.array(flat)
        others = np.ones(flat.shape[-1], np.bool_)
        others[self._places] = False
        executed[..., others] = bounded[..., others]
        kept = bounded[..., self._places] == speeds[..., self._places]
        wanted = self._last + bounded[..., self._places] * self._seconds
        nearest = wanted.astype(executed.dtype)
        is_beyond = np.abs(nearest - self._last) > np.abs(wanted - self._last)
        inwards = np.nextafter(nearest, self._last.astype(executed.dtype))
        bounded_targets = np.where(is_beyond, inwards, nearest)
        executed[..., self._places] = np.where(kept, flat[..., self._places], bounded_targets)
        return executed

    def take(self, executed: Array, which: NDArray[np.bool_] | None = None) -> None:
        """Record the executed targets, in all environments or in the marked ones."""
        taken = np.array(executed[..., self._places], np.float64)
        self._last = taken if which is None else np.where(which[:, None], taken, self._last)


def with_speeds(act: Declared, names: Mapping[str, int]) -> Declared:
    """The declarations for a guard, with the unit of a target per second."""
    return {name: _by_second(place) if name in names else place for name, place in act.items()}


def _by_second(place: Place) -> Place:
    return (place[0], f"{place[1]}/s") if isinstance(place, tuple) else place


def _place(name: str, act: Declared) -> int:
    place = act.get(name)
    index = place[0] if isinstance(place, tuple) else place
    if not isinstance(index, int):
        raise MappingError(f"`{name}` is a target, so `act` needs its index: a number")
    return index
