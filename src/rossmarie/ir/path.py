"""Paths from a message to a field, or to an element of an array in it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class ByName:
    """The element of an array that has the name `key`: its place is the place of that string in the
    list `names`, which is a path from the message. There is none where the list has the string not
    at all, or more than once, or has another length than the array (S7).
    """

    names: tuple[str, ...]
    key: str

    def __str__(self) -> str:
        return self.key

    def is_among(self, names: Sequence[str]) -> bool:
        """Say whether one of these names, and no other, is that of the element."""
        return names.count(self.key) == 1

    def place(self, names: Sequence[str], length: int) -> int | None:
        """The place of the element in an array of a length, where the list has these names."""
        return names.index(self.key) if len(names) == length and self.is_among(names) else None


@dataclass(frozen=True)
class Listed:
    """The element of an array that has the name `key` by a list of `count` names in the rules:
    `place` is the place of the name there. There is none where the array has another length (S55).
    """

    place: int
    count: int
    key: str

    def __str__(self) -> str:
        return self.key

    def place_among(self, length: int) -> int | None:
        """The place of the element in an array of a length."""
        return self.place if length == self.count else None


@dataclass(frozen=True)
class Each:
    """Every element of a list of messages: what stands behind it is a field of each of them."""


EACH = Each()


@dataclass(frozen=True)
class Points:
    """The points of a `sensor_msgs/PointCloud2`, as a list: the cloud itself says, message by
    message, which fields they have, and where in its bytes (S56).
    """

    def __str__(self) -> str:
        return "points"


POINTS = Points()

AXES = ("x", "y", "z")
"""The fields that are the place of a point: what has no place is no point (S57)."""

Step = str | int | ByName | Listed | Each | Points
"""The name of a field, the place or the name of an element, every element, or the points of a
cloud.
"""

Path = tuple[Step, ...]


def extent(element: int | Listed) -> tuple[int, int]:
    """The place of an element, and the least length of an array that has it."""
    if isinstance(element, int):
        return element, element + 1
    return element.place, element.count


def path_text(path: Iterable[Step]) -> str:
    """A path as users write it behind the name of an input: `.position[0]`, `.effort["elbow"]`."""
    return "".join(map(_step_text, path))


def path_words(path: Iterable[Step]) -> str:
    """A path by itself: `pose.position.x`, `effort[2]`."""
    return path_text(path).removeprefix(".")


def path_names(path: Iterable[Step]) -> list[str]:
    """The names on a path, places and names of elements included; what all elements of a list have
    goes by the name of the field alone.
    """
    return [str(step) for step in path if step != EACH]


def _step_text(step: Step) -> str:
    match step:
        case str():
            return f".{step}"
        case int():
            return f"[{step}]"
        case ByName(key=key) | Listed(key=key):
            return f'["{key}"]'
        case Each():
            return "[]"
        case Points():
            return f".{step}"
