"""Conversion of the actions of an environment to flat arrays of numbers, and back: vectors, or
numbers of choices.

All functions work on one action, of shape (m,), and on the actions of many environments, of shape
(n, m).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import prod
from typing import Any, Protocol, TypeAlias

import numpy as np
from gymnasium import Space, spaces
from numpy.typing import NDArray

from rossmarie.guard import Declared, MappingError
from rossmarie.gym.observations import Array, Spots

Allows: TypeAlias = Callable[[Array], NDArray[np.bool_]]
"""A function that says which flat actions, of shape (k, m), would pass unchanged. Its result has
the shape (k,) or (n, k).
"""


class Actions(Protocol):
    """The actions of one environment."""

    declared: Declared
    """The meaning of the numbers of flat actions, for a guard."""
    size: int
    """The number of values in a flat action."""

    def flat(self, action: Any) -> Array:
        """Actions as flat arrays. Raises `ValueError` if a value is not an action of the space."""

    def executed(self, action: Any, bounded: Array, allows: Allows, /) -> Any:
        """The actions to execute, from the proposed actions and the actions that the guard has
        bounded.
        """

    def mask(self, allows: Allows, /) -> NDArray[np.int8] | None:
        """A mask of the choices that would pass unchanged; None if actions are not choices."""


def actions_of(space: Space[Any], act: Mapping[str, Any]) -> Actions:
    """The actions of a space with their declarations. Raises `MappingError` for other spaces."""
    match space:
        case spaces.Box() if space.dtype in (np.float64, np.float32):
            return Vectors(space, act)
        case spaces.Discrete():
            return Choices(space, act)
        case _:  # open: Gymnasium has more spaces, and users define their own
            raise MappingError(
                f"actions are {space}; a guard bounds a Box of floats, or a Discrete choice"
            )


class Vectors:
    """Actions that are arrays of floats."""

    def __init__(self, space: spaces.Box, act: Spots) -> None:
        self._shape = space.shape
        self.size = prod(space.shape)
        self.declared: Declared = {
            name: tuple(spot) if isinstance(spot, list) else spot  # type: ignore[misc]
            for name, spot in act.items()
        }

    def flat(self, action: Any) -> Array:
        """Actions as flat arrays. Values that are arrays are not copied."""
        array = np.asarray(action)
        leading = array.shape[: array.ndim - len(self._shape)]
        if array.shape != (*leading, *self._shape):
            raise ValueError(f"an action has the shape {self._shape}, not {array.shape}")
        return array.reshape((*leading, -1))

    def executed(self, action: Any, bounded: Array, _: Allows, /) -> Any:
        """The bounded actions in their own shape."""
        return bounded.reshape(np.shape(action))

    def mask(self, _: Allows, /) -> None:
        """None, because actions are not choices."""


class Choices:
    """Actions that are numbers of choices. `act` has a list with the number of each choice."""

    def __init__(self, space: spaces.Discrete, act: Mapping[str, Any]) -> None:
        self._first = int(space.start)
        self.declared: Declared = {}
        columns: list[Sequence[float]] = []
        for name, given in act.items():
            numbers, unit = given if _has_unit(given) else (given, None)
            if np.shape(numbers) != (int(space.n),) or not np.isfinite(numbers).all():
                raise MappingError(
                    f"`{name}` must be a list of {space.n} finite numbers, one for each choice"
                )
            self.declared = {
                **self.declared,
                name: len(columns) if unit is None else (len(columns), unit),
            }
            columns.append(numbers)
        self.size = len(columns)
        self._table = np.array(columns, np.float64).reshape(len(columns), -1).T.copy()

    def flat(self, action: Any) -> Array:
        """The numbers of the choices."""
        choices = np.asarray(action)
        last = self._first + len(self._table) - 1
        is_whole = choices.dtype.kind in "iu"
        if not is_whole or ((choices < self._first) | (choices > last)).any():
            raise ValueError(f"an action is a choice from {self._first} to {last}, not {action}")
        found: Array = self._table[choices - self._first]
        return found

    def executed(self, action: Any, bounded: Array, allows: Allows, /) -> Any:
        """The choices themselves if they pass unchanged; otherwise the passing choice nearest to
        the bounded numbers. If no choice passes, the nearest choice.
        """
        is_changed = (bounded != self.flat(action)).any(axis=-1)
        if not is_changed.any():
            return action
        distances = np.abs(self._table - bounded[..., None, :]).max(axis=-1)
        passing = allows(self._table)
        distances = np.where(passing | ~passing.any(axis=-1, keepdims=True), distances, np.inf)
        nearest = distances.argmin(axis=-1) + self._first
        chosen = np.where(is_changed, nearest, action).astype(np.asarray(action).dtype)
        return chosen if chosen.ndim else chosen[()]

    def mask(self, allows: Allows, /) -> NDArray[np.int8]:
        """1 for each choice that would pass unchanged."""
        return allows(self._table).astype(np.int8)


def _has_unit(given: Any) -> bool:
    return isinstance(given, tuple | list) and len(given) == 2 and isinstance(given[1], str)
