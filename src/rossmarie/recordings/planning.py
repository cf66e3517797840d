"""Plans for reading: from the definition of a message to the steps that find its fields."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

from rosbags.interfaces import Nodetype
from rosbags.typesys.store import Typestore

from rossmarie.ir import ByName, Doing, FieldKind, Listed, Path, Quantity
from rossmarie.ir.beams import is_of_scan
from rossmarie.recordings import extraction
from rossmarie.recordings.definitions import full_type
from rossmarie.recordings.plan import (
    ByteStretch,
    NumberArray,
    NumberSequence,
    ReadPlan,
    Records,
    SlotPart,
    SlotTarget,
    Step,
    StretchNumber,
    TextBytes,
)

_KINDS = {
    "bool": "?",
    "byte": "i1",
    "char": "u1",
    "int8": "i1",
    "uint8": "u1",
    "int16": "i2",
    "uint16": "u2",
    "int32": "i4",
    "uint32": "u4",
    "int64": "i8",
    "uint64": "u8",
    "float32": "f4",
    "float64": "f8",
}
_COUNT = 4
"""The bytes of the length before a text or an array."""
_WIDEST = 8
_FILLER = "structure_needs_at_least_one_member"
"""The member that ROS 2 adds to a type without fields; ROS 1 does not."""


class _Wanted(NamedTuple):
    """A slot or an array, by its index in the machine, and the path to it from here."""

    path: Path
    slot: int | None = None
    array: int | None = None
    part: SlotPart = SlotPart.ALL


class _NotPlannedError(Exception):
    """A definition has a field for which no step exists."""


def plan_for(
    store: Typestore, message_type: str, encoding: str, wanted: extraction.WantedParts
) -> ReadPlan | None:
    """The plan for messages of a type; None if no plan is possible. `encoding` is `ros1` or `cdr`.
    The definition contains all wanted fields.
    """
    is_cdr = encoding == "cdr"
    planner = _Planner(store, is_cdr, multiple=_WIDEST)
    steps = {step for slot in wanted.slots.values() for step in slot.path}
    if any(isinstance(step, ByName | Listed) for step in steps):
        return None  # the place of the element depends on the names, or on the length
    if any(isinstance(step, Doing | Quantity) for step in steps):
        return None  # queries about skills need all running skills
    if any(array.list is not None for array in wanted.arrays.values()):
        return None  # rosbags decodes lists of messages
    if any(is_of_scan(array) for array in wanted.arrays.values()):
        return None  # a sector depends on other fields, too
    slots = [_Wanted(slot.path, slot=index) for index, slot in wanted.slots.items()]
    arrays = [_Wanted(array.path, array=index) for index, array in wanted.arrays.items()]
    try:
        planner.message(full_type(message_type), [*slots, *arrays])
    except _NotPlannedError:
        return None
    is_text = {index: slot.kind is FieldKind.TEXT for index, slot in wanted.slots.items()}
    return ReadPlan(
        is_cdr,
        planner.steps(),
        slots=tuple(index for index in wanted.slots if not is_text[index]),
        texts=tuple(index for index in wanted.slots if is_text[index]),
        arrays=tuple(wanted.arrays),
    )


class _Planner:
    """Walks through a definition. The present place lies `_beyond` bytes after a multiple of
    `_multiple` bytes from the start of the message.
    """

    def __init__(self, store: Typestore, is_cdr: bool, multiple: int) -> None:
        self._store = store
        self._is_cdr = is_cdr
        self._multiple = multiple
        self._beyond = 0
        self._done: list[Step] = []
        self._align = 1
        self._size = 0
        self._reads: list[StretchNumber | NumberArray] = []

    def steps(self) -> tuple[Step, ...]:
        """The steps so far."""
        self._close()
        return tuple(self._done)

    def message(self, name: str, wanted: Sequence[_Wanted]) -> None:
        """Add the steps of a message, or of a nested message."""
        if name not in self._store.fielddefs:
            raise _NotPlannedError
        for field, description in self._store.fielddefs[name][1]:
            inner = _below(wanted, field)
            if self._is_cdr or field != _FILLER:
                self._field(description, inner)
            elif inner:
                raise _NotPlannedError

    def _field(self, description: Any, wanted: Sequence[_Wanted]) -> None:
        """Add the steps of a field. `description` has the form of rosbags."""
        kind, content = description
        if kind == Nodetype.NAME:
            self.message(content, [part for each in wanted for part in _parts(each)])
        elif kind == Nodetype.BASE:
            self._base(content[0], wanted)
        elif kind == Nodetype.ARRAY:
            element, count = content
            self._fixed_array(element, count, wanted)
        else:
            self._array(content[0], wanted)

    def _base(self, name: str, wanted: Sequence[_Wanted]) -> None:
        if name == "string":
            self._count()
            self._done.append(
                TextBytes(tuple(each.slot for each in wanted if each.slot is not None))
            )
            self._lose_count()
            return
        kind, size = _number(name)
        self._place(size)
        if targets := _targets(wanted):
            self._reads.append(StretchNumber(targets, kind, self._size))
        self._skip(size)

    def _fixed_array(self, element: Any, count: int, wanted: Sequence[_Wanted]) -> None:
        if not _is_number(element):
            for index in range(count):
                self._field(element, _below(wanted, index))
            return
        kind, size = _number(element[1][0])
        self._place(size)
        if arrays := _arrays(wanted):
            self._reads.append(NumberArray(arrays, kind, self._size, count))
        for index in sorted(_indexes(wanted)):
            if index < count:
                targets = _targets(_below(wanted, index))
                self._reads.append(StretchNumber(targets, kind, self._size + index * size))
        self._skip(count * size)

    def _array(self, element: Any, wanted: Sequence[_Wanted]) -> None:
        self._count()
        indexes = sorted(_indexes(wanted))
        if _is_number(element):
            kind, size = _number(element[1][0])
            elements = {index: _targets(_below(wanted, index)) for index in indexes}
            align = size if self._is_cdr else 1
            self._done.append(NumberSequence(align, kind, size, elements, _arrays(wanted)))
        else:
            bodies = {index: self._body(element, _below(wanted, index)) for index in indexes}
            self._done.append(Records(bodies, self._body(element, ())))
        self._lose_count()

    def _body(self, element: Any, wanted: Sequence[_Wanted]) -> tuple[Step, ...]:
        """The steps through an element at any place."""
        planner = _Planner(self._store, self._is_cdr, multiple=1)
        planner._field(element, wanted)
        return planner.steps()

    # --- places ------------------------------------------------------------------------------

    def _place(self, size: int) -> None:
        """Move to the next possible place of a number with this size in bytes."""
        if not self._is_cdr:
            return
        if self._multiple % size == 0:
            self._skip(-self._beyond % size)
        else:
            self._close()
            self._align = self._multiple = size
            self._beyond = 0

    def _skip(self, size: int) -> None:
        self._size += size
        self._beyond = (self._beyond + size) % self._multiple

    def _count(self) -> None:
        """Read the length at the beginning of a text or an array."""
        self._place(_COUNT)
        self._close()

    def _lose_count(self) -> None:
        """Forget the alignment: the end of the array is unknown."""
        self._multiple, self._beyond = 1, 0

    def _close(self) -> None:
        if self._size or self._align > 1:
            self._done.append(ByteStretch(self._align, self._size, tuple(self._reads)))
        self._align, self._size, self._reads = 1, 0, []


# --- what is wanted --------------------------------------------------------------------------


def _below(wanted: Iterable[_Wanted], step: str | int) -> list[_Wanted]:
    """The fields that are wanted after a step of the path."""
    found = (each for each in wanted if each.path and each.path[0] == step)
    return [each._replace(path=each.path[1:]) for each in found]


def _parts(wanted: _Wanted) -> tuple[_Wanted, ...]:
    """The two numbers of an instant."""
    if wanted.path:
        return (wanted,)
    return (
        wanted._replace(path=("sec",), part=SlotPart.SECONDS),
        wanted._replace(path=("nanosec",), part=SlotPart.NANOSECONDS),
    )


def _targets(wanted: Iterable[_Wanted]) -> tuple[SlotTarget, ...]:
    return tuple(SlotTarget(each.slot, each.part) for each in wanted if each.slot is not None)


def _arrays(wanted: Iterable[_Wanted]) -> tuple[int, ...]:
    return tuple(each.array for each in wanted if each.array is not None and not each.path)


def _indexes(wanted: Iterable[_Wanted]) -> set[int]:
    return {each.path[0] for each in wanted if each.path and isinstance(each.path[0], int)}


def _is_number(description: Any) -> bool:
    return description[0] == Nodetype.BASE and description[1][0] in _KINDS


def _number(name: str) -> tuple[str, int]:
    """The kind of a number, and its size in bytes."""
    if name not in _KINDS:
        raise _NotPlannedError
    kind = _KINDS[name]
    return kind, int(kind[1:] or 1)
