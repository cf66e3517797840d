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


class SlotPart(enum.Enum):
    """The parts of a slot that a number may fill."""

    ALL = "all"
    SECONDS = "seconds"
    NANOSECONDS = "nanoseconds"


class SlotTarget(NamedTuple):
    """A slot, or a part of it."""

    slot: int
    part: SlotPart


@dataclass(frozen=True)
class StretchNumber:
    """A number in a stretch, `offset` bytes from the start of the stretch; `kind` is a NumPy type:
    `f8`.
    """

    targets: tuple[SlotTarget, ...]
    kind: str
    offset: int


@dataclass(frozen=True)
class NumberArray:
    """An array of `count` numbers in a stretch."""

    arrays: tuple[int, ...]
    kind: str
    offset: int
    count: int


@dataclass(frozen=True)
class ByteStretch:
    """Bytes with fixed distances from the first byte, which lies at a multiple of `align` bytes
    from the start of the message.
    """

    align: int
    size: int
    reads: tuple[StretchNumber | NumberArray, ...]


@dataclass(frozen=True)
class TextBytes:
    """A string: its length in four bytes, followed by its bytes."""

    slots: tuple[int, ...]


@dataclass(frozen=True)
class NumberSequence:
    """An array of numbers of any length: the count in four bytes, followed by the numbers. The
    first number, if any, lies at a multiple of `align`. `elements` are the elements that are read
    by index.
    """

    align: int
    kind: str
    size: int
    elements: Mapping[int, tuple[SlotTarget, ...]]
    arrays: tuple[int, ...]


@dataclass(frozen=True)
class Records:
    """An array of texts or messages of any length: the count, followed by the steps for each
    element. `elements` contains the steps of the elements from which a field is read.
    """

    elements: Mapping[int, tuple[Step, ...]]
    others: tuple[Step, ...]


Step: TypeAlias = ByteStretch | TextBytes | NumberSequence | Records


@dataclass(frozen=True)
class ReadPlan:
    """The steps through the messages of a type, and all slots and arrays that they fill. Slots in
    `texts` are filled with the numbers of texts. With `is_cdr`, four bytes precede the message, and
    alignment counts from the end of these bytes; a plan for ROS 1 aligns nothing.
    """

    is_cdr: bool
    steps: tuple[Step, ...]
    slots: tuple[int, ...]
    texts: tuple[int, ...]
    arrays: tuple[int, ...]
