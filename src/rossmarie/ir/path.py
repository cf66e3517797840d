"""Paths from a message to a field, or to an element of an array in it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class ByName:
    """The element of an array with the name `key`. Its place is the place of this string in the
    list `names`, which is a path from the message. The element does not exist if the list does not
    contain the string exactly once, or if the lengths of list and array differ (S7).
    """

    names: tuple[str, ...]
    key: str

    def __str__(self) -> str:
        return self.key

    def is_among(self, names: Sequence[str]) -> bool:
        """Say whether exactly one of these names is the name of the element."""
        return names.count(self.key) == 1

    def place(self, names: Sequence[str], length: int) -> int | None:
        """The place of the element in an array of this length, if the list has these names."""
        return names.index(self.key) if len(names) == length and self.is_among(names) else None


@dataclass(frozen=True)
class Listed:
    """The element of an array with the name `key` in a list of `count` names in the rules. `place`
    is the place of the name in the list. The element does not exist if the array has another length
    (S55).
    """

    place: int
    count: int
    key: str

    def __str__(self) -> str:
        return self.key

    def place_among(self, length: int) -> int | None:
        """The place of the element in an array of this length."""
        return self.place if length == self.count else None


@dataclass(frozen=True)
class Each:
    """Every element of a list of messages. The next step is a field of each element."""


EACH = Each()


@dataclass(frozen=True)
class Points:
    """The points of a `sensor_msgs/PointCloud2`, as a list. Each message describes the fields of
    the points and their places in the bytes (S56).
    """

    def __str__(self) -> str:
        return "points"


POINTS = Points()


@dataclass(frozen=True)
class Sector:
    """A step after the `ranges` of a `sensor_msgs/LaserScan`: the readings between two angles, as
    an array. The angles are in radians, from `first` counter-clockwise over `width`. Each scan
    contains the angles of its beams (S71).
    """

    first: float
    width: float

    def __str__(self) -> str:
        return f"{_degrees(self.first)} .. {_degrees(self.first + self.width)}"


@dataclass(frozen=True)
class Beams:
    """Beams of a `sensor_msgs/LaserScan`, as a list: its `points` (S72), or the beams without a
    reading (S73).
    """

    name: str

    def __str__(self) -> str:
        return self.name


RETURNS, INVALID = Beams("points"), Beams("invalid")


@dataclass(frozen=True)
class Doing:
    """The flag "a running skill is one of `skills`, and its arguments have these classes", of a
    `skill_context_msgs/SkillContext`. `arguments` are pairs of a parameter and the allowed classes
    of its argument. Skills and classes include everything that is derived from those in the rules,
    sorted, so readers need no hierarchy.

    With `is_ahead`, the query is about skills that can start next; an unknown argument may be of
    any class.

    `written` is the notation of the rules, without optional name spaces.
    """

    export: str
    skills: tuple[str, ...]
    arguments: tuple[tuple[str, tuple[str, ...]], ...] = ()
    is_ahead: bool = False
    written: str = ""

    def __str__(self) -> str:
        word = "ahead" if self.is_ahead else "doing"
        return self.written or f"{word} {_choice(self.skills)}{self._limits()}"

    def _limits(self) -> str:
        limits = (f"{parameter}: {_choice(classes)}" for parameter, classes in self.arguments)
        return f"({', '.join(limits)})" if self.arguments else ""


@dataclass(frozen=True)
class Quantity:
    """The number that is the argument `parameter` of the single running skill among `skills`, in a
    `skill_context_msgs/SkillContext`. With a `property`, the number is this property of the
    individual in the argument. The number is in SI if it has a unit. A boolean is 0 or 1
    (`is_boolean`). `skills` and `written` are like those of `Doing`.
    """

    export: str
    skills: tuple[str, ...]
    parameter: str
    property: str | None = None
    written: str = ""
    is_boolean: bool = False

    def __str__(self) -> str:
        behind = "" if self.property is None else f".{self.property}"
        return self.written or f"{_choice(self.skills)}.{self.parameter}{behind}"


SkillStep = Doing | Quantity
"""A query about the running skills. It applies to the message itself, as the only step of its
path.
"""

AXES = ("x", "y", "z")
"""The fields with the position of a point. Without a position there is no point (S57)."""

Step = str | int | ByName | Listed | Each | Points | Sector | Beams | Doing | Quantity
"""The name of a field, the place or the name of an element, every element, the points of a cloud, a
sector or the beams of a scan, or a query about the running skills.
"""

Path = tuple[Step, ...]


def extent(element: int | Listed) -> tuple[int, int]:
    """The place of an element, and the least length of an array with the element."""
    if isinstance(element, int):
        return element, element + 1
    return element.place, element.count


def path_text(path: Iterable[Step]) -> str:
    """A path in the user's notation after the name of an input: `.position[0]`,
    `.effort["elbow"]`.
    """
    return "".join(map(_step_text, path))


def path_words(path: Iterable[Step]) -> str:
    """A path without an input: `pose.position.x`, `effort[2]`."""
    return path_text(path).removeprefix(".")


def path_names(path: Iterable[Step]) -> list[str]:
    """The names on a path, including places and names of elements. For a field of all elements of a
    list, they are the names of the field alone; for a sector, the name of the array with its
    angles.
    """
    names: list[str] = []
    for step in path:
        if isinstance(step, Sector):
            names[-1:] = [f"{''.join(names[-1:])}[{step}]"]
        elif step != EACH:
            names.append(str(step))
    return names


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
        case Sector():
            return f"[{step}]"
        case Points() | Beams() | Doing() | Quantity():
            return f".{step}"


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.10g} deg"


def _choice(names: Sequence[str]) -> str:
    return " or ".join(names)
