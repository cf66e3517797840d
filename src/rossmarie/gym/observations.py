"""Observations of an environment as flat arrays of numbers, for a guard."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import prod
from typing import Any, TypeAlias

import numpy as np
from gymnasium import Space, spaces
from numpy.typing import NDArray

from rossmarie.guard import Declared, MappingError, Place
from rossmarie.ir import near_name

Array: TypeAlias = NDArray[Any]
Index: TypeAlias = "int | slice"
Spot: TypeAlias = "Place | str | tuple[str, Index] | tuple[str, Index, str] | list[Any]"
"""The place of a field. It is a place of `Guard`. If an observation is a dictionary, it is the key
of an entry and the place in the entry (`"arm.joints"` for a nested entry). A key alone means all
numbers of the entry. A list is the same as a tuple, for specifications from JSON.
"""

Spots: TypeAlias = Mapping[str, Spot]
_FLOATS = (np.float64, np.float32)


@dataclass(frozen=True)
class _Leaf:
    """An entry of observations with `size` numbers, beginning at `first`."""

    keys: tuple[str | int, ...]
    first: int
    size: int

    @property
    def name(self) -> str:
        return ".".join(map(str, self.keys))


class Observations:
    """The observations of one environment."""

    def __init__(self, space: Space[Any]) -> None:
        """Raises `MappingError` for a space that contains other values than numbers."""
        self._leaves: list[_Leaf] = []
        for keys, part in _parts(space, ()):
            first = self._leaves[-1].first + self._leaves[-1].size if self._leaves else 0
            self._leaves.append(_Leaf(keys, first, prod(part.shape or ())))
        self.size = sum(leaf.size for leaf in self._leaves)
        self._by_name = {leaf.name: leaf for leaf in self._leaves}

    def declared(self, spots: Spots) -> Declared:
        """The declarations for flat observations. Raises `MappingError` for an entry that does not
        exist.
        """
        return {name: self.place(name, spot) for name, spot in spots.items()}

    def place(self, name: str, spot: Spot) -> Place:
        """The place of a field in flat observations."""
        parts = tuple(spot) if isinstance(spot, list) else spot
        if isinstance(parts, str):
            parts = (parts, slice(None))
        if not isinstance(parts, tuple) or not isinstance(parts[0], str):
            return parts
        key, index, *unit = parts
        leaf = self._leaf(name, key)
        place = _within(name, leaf, index)
        return (place, unit[0]) if unit else place

    def number(self, name: str, spot: Spot) -> int:
        """The index of a single number. Raises `MappingError` if the place is not a single
        number.
        """
        place = self.place(name, spot)
        if isinstance(place, slice):
            places = range(*place.indices(self.size))
            place = places[0] if len(places) == 1 else None
        if not isinstance(place, int) or not -self.size <= place < self.size:
            raise MappingError(f"`{name}`: {spot!r} is not a single number of an observation")
        return place

    def row(self, value: Any) -> Array:
        """One observation as a flat array."""
        return self._joined(value, (-1,))

    def rows(self, values: Any, count: int) -> Array:
        """Observations of several environments, of shape (count, numbers)."""
        return self._joined(values, (count, -1))

    def _leaf(self, name: str, key: str) -> _Leaf:
        if key not in self._by_name:
            near = near_name(key, self._by_name)
            meant = f"; did you mean `{near}`?" if near else ""
            raise MappingError(f"`{name}`: observations have no entry `{key}`{meant}")
        return self._by_name[key]

    def _joined(self, value: Any, shape: tuple[int, ...]) -> Array:
        parts = [np.reshape(_entry(value, leaf.keys), shape) for leaf in self._leaves]
        if len(parts) == 1 and parts[0].dtype in _FLOATS:
            return parts[0]
        return np.concatenate(parts, axis=-1, dtype=np.float64)


def _parts(
    space: Space[Any], keys: tuple[str | int, ...]
) -> Iterator[tuple[tuple[str | int, ...], Space[Any]]]:
    """The spaces of numbers inside a space, in order."""
    entries: Sequence[tuple[str | int, Space[Any]]] = ()
    match space:
        case spaces.Dict():
            entries = list(space.spaces.items())
        case spaces.Tuple():
            entries = list(enumerate(space.spaces))
        case spaces.Box() | spaces.Discrete() | spaces.MultiBinary() | spaces.MultiDiscrete():
            yield keys, space
        case _:  # open: Gymnasium has more spaces, and users define their own
            where = f"entry `{'.'.join(map(str, keys))}` of the observations" if keys else (
                "observation space"
            )  # fmt: skip
            raise MappingError(
                f"the {where} is a {type(space).__name__}, which contains no numbers"
            )
    for key, part in entries:
        yield from _parts(part, (*keys, key))


def _within(name: str, leaf: _Leaf, index: Any) -> Index:
    """The place in flat observations of an index in a leaf."""
    if isinstance(index, slice):
        places = range(*index.indices(leaf.size))
        stop = leaf.first + places.stop
        return slice(leaf.first + places.start, None if stop < 0 else stop, places.step)
    if not isinstance(index, int) or not -leaf.size <= index < leaf.size:
        raise MappingError(f"`{name}` is {leaf.name}[{index}], of {leaf.size} numbers")
    return leaf.first + index % leaf.size


def _entry(value: Any, keys: tuple[str | int, ...]) -> Any:
    for key in keys:
        value = value[key]
    return value
