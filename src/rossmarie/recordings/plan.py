"""The places of the fields that rules read in an encoded message, as steps from its start to its
end.

Each step leads from one place to the next. It names the *targets* that it fills: slots, parts of
slots (the two numbers of an instant), and arrays.
"""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias


class Part(enum.Enum):
    """The part of a slot that a number is."""

    ALL = "all"
    SECONDS = "seconds"
    NANOSECONDS = "nanoseconds"


class Target(NamedTuple):
    """A slot, or a part of it."""

    slot: int
    part: Part


@dataclass(frozen=True)
class Number:
    """A number in a stretch, `offset` bytes from its start; `kind` is that of numpy: `f8`."""

    targets: tuple[Target, ...]
    kind: str
    offset: int


@dataclass(frozen=True)
class Row:
    """An array of `count` numbers in a stretch."""

    arrays: tuple[int, ...]
    kind: str
    offset: int
    count: int


@dataclass(frozen=True)
class Stretch:
    """Bytes of which each has its distance from the first one, which lies at a multiple of `align`
    bytes from the start of the message.
    """

    align: int
    size: int
    reads: tuple[Number | Row, ...]


@dataclass(frozen=True)
class Text:
    """A string: its length in bytes, in four bytes, and then itself."""

    slots: tuple[int, ...]


@dataclass(frozen=True)
class Numbers:
    """An array of numbers of any length: how many there are, in four bytes, and then they. The
    first one lies at a multiple of `align`, if there is one. `elements` are those read by index.
    """

    align: int
    kind: str
    size: int
    elements: Mapping[int, tuple[Target, ...]]
    arrays: tuple[int, ...]


@dataclass(frozen=True)
class Records:
    """An array of texts or messages of any length: how many there are, and then the steps for each;
    `elements` are those of the elements in which something is read.
    """

    elements: Mapping[int, tuple[Step, ...]]
    others: tuple[Step, ...]


Step: TypeAlias = Stretch | Text | Numbers | Records


@dataclass(frozen=True)
class ReadPlan:
    """The steps through the messages of a type, and all slots and arrays that they fill; those of
    `texts` are filled with the numbers of texts. `is_cdr` says that four bytes stand in front, from
    behind which all is aligned; a plan for ROS 1 aligns nothing.
    """

    is_cdr: bool
    steps: tuple[Step, ...]
    slots: tuple[int, ...]
    texts: tuple[int, ...]
    arrays: tuple[int, ...]
