"""Steps of guards in C: an observation arrives, and an action is changed into a permitted
action.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence
from operator import index as as_index
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from rossmarie.ir import FieldPart, Machine, Wiring, margins_of, require_instant
from rossmarie.native.library import NativeLibrary, Pointer

Floats: TypeAlias = NDArray[np.float64]
StepCall: TypeAlias = Callable[[int, "NDArray[Any] | None", "NDArray[Any] | None"], "bytes | None"]
"""A call takes an instant in ns, an observation, and an action that is changed in place. It returns
the facts after the step, or None if the arguments do not fit. If the observation is None, no
message arrives; if the action is None, the decision comes later.
"""

AllowCall: TypeAlias = Callable[[Floats], "NDArray[np.bool_]"]
"""A function that returns which actions, of shape (k, m), would pass unchanged after the last
observation.
"""

DECLARATIONS = """
typedef struct guard_part {
    int64_t first;
    int64_t step;
    size_t count;
    double scale;
    double offset;
    int32_t is_flag;
    int32_t command;
    int32_t field;
    int32_t unused;
} guard_part;
typedef struct guard_publication {
    int32_t task;
    int32_t command;
    int32_t lasts;
    int32_t first;
} guard_publication;
typedef struct guard_wiring {
    size_t observed;
    size_t acted;
    size_t slot_count;
    size_t array_count;
    size_t part_count;
    size_t publication_count;
    unsigned char *present;
    guard_part *slots;
    guard_part *arrays;
    int32_t *clouds;
    unsigned char *is_axis;
    guard_part *parts;
    guard_publication *publications;
    double *published;
    double *slot_room;
    double *element_room;
    double **array_room;
    size_t *count_room;
    double *bound_room;
    double *action_room;
} guard_wiring;
int guard_step(host *, guard_wiring *, int64_t, double *, double *);
void guard_note(host *, unsigned char *, int64_t *);
void guards_margins(host *, size_t, double *);
host *guards_new(size_t);
void guards_free(host *, size_t);
host *guards_at(host *, size_t);
void guards_restart(host *, size_t, unsigned char *);
size_t guards_step(host *, size_t, guard_wiring *, unsigned char *, int64_t *, size_t, double *,
                   double *, unsigned char *, unsigned char *);
size_t guards_allow(host *, size_t, guard_wiring *, double *, size_t, unsigned char *);
"""

_BYTES = "unsigned char[]"
CHANGED, REFUSED, REPORTED, CLOSED = 1, 2, 4, 8
"""The bits of a step: the action was changed; the action was not finite; there are events or task
commands; nothing passes yet.
"""


class WiringTable:
    """A wiring in C. The table must live while `pointer` is used."""

    def __init__(self, library: NativeLibrary, wiring: Wiring, channels: int, fields: int) -> None:
        """Reserve memory for the given number of channels, and for the largest number of fields of
        a command.
        """
        present = [int(channel in wiring.arriving) for channel in range(channels)] or [0]
        elements = sum(part.count for part in wiring.arrays)
        published = [number for each in wiring.publications for number in each.numbers]
        members = {
            "observed": wiring.observed,
            "acted": wiring.acted,
            "slot_count": len(wiring.slots),
            "array_count": len(wiring.arrays),
            "part_count": len(wiring.commands),
            "publication_count": len(wiring.publications),
            "present": library.new("unsigned char[]", present),
            "slots": library.new("guard_part[]", [_part(part) for part in wiring.slots] or 1),
            "arrays": library.new("guard_part[]", [_part(part) for part in wiring.arrays] or 1),
            "clouds": library.new("int32_t[]", _clouds(wiring) or 1),
            "is_axis": library.new("unsigned char[]", _axes(wiring) or 1),
            "parts": library.new(
                "guard_part[]",
                [_part(each.part, each.command, each.field) for each in wiring.commands] or 1,
            ),
            "publications": library.new("guard_publication[]", _publications(wiring) or 1),
            "published": library.new("double[]", published or 1),
            "slot_room": library.new("double[]", len(wiring.slots) or 1),
            "element_room": library.new("double[]", elements or 1),
            "array_room": library.new("double *[]", len(wiring.arrays) or 1),
            "count_room": library.new("size_t[]", len(wiring.arrays) or 1),
            "bound_room": library.new("double[]", 3 * fields or 1),
            "action_room": library.new("double[]", wiring.acted or 1),
        }
        self.pointer = library.new("guard_wiring *", members)
        self._memory = members


def _part(part: FieldPart, command: int = 0, field: int = 0) -> Sequence[float]:
    return (
        part.first, part.step, part.count, part.scale, part.offset, part.is_flag, command, field, 0,
    )  # fmt: skip


def _clouds(wiring: Wiring) -> list[int]:
    """For each array, the cloud of which it is a column; -1 if there is none."""
    owners = {column: cloud for cloud, each in enumerate(wiring.clouds) for column in each.columns}
    return [owners.get(array, -1) for array in range(len(wiring.arrays))]


def _axes(wiring: Wiring) -> list[int]:
    axes = {axis for each in wiring.clouds for axis in each.axes}
    return [int(array in axes) for array in range(len(wiring.arrays))]


def _publications(wiring: Wiring) -> list[tuple[int, ...]]:
    found: list[tuple[int, ...]] = []
    first = 0
    for each in wiring.publications:
        found.append((each.task, each.command, each.is_lasting, first))
        first += len(each.numbers)
    return found


def plain_step(
    library: NativeLibrary, host: Pointer, table: WiringTable, note: NoteCall
) -> StepCall:
    """A step that works without Python's headers."""
    call = library.function("guard_step")

    def step(
        at_ns: int, observation: NDArray[Any] | None, action: NDArray[Any] | None
    ) -> bytes | None:
        wiring = table.pointer  # the table keeps its own memory alive
        if not (fits(observation, wiring.observed) and fits(action, wiring.acted)):
            return None
        require_instant(as_index(at_ns))
        numbers = None if action is None else action.astype(np.float64)
        seen = None if observation is None else np.ascontiguousarray(observation, np.float64)
        said = call(
            host,
            wiring,
            at_ns,
            library.pointer("double[]", seen),
            library.pointer("double[]", numbers),
        )
        if said < 0:
            return None
        if action is not None and numbers is not None and said & CHANGED:
            put_back(numbers, action)
        return note(said)

    return step


NoteCall: TypeAlias = Callable[[int], bytes]


def fits(array: object, length: int) -> bool:
    """Say whether a value is a float array of this length, or None."""
    return array is None or (
        isinstance(array, np.ndarray)
        and array.shape == (length,)
        and array.dtype in (np.float64, np.float32)
    )


def put_back(numbers: Floats, action: NDArray[Any]) -> None:
    """Put numbers into an array. A float32 is rounded towards 0."""
    with np.errstate(over="ignore"):
        nearest = numbers.astype(action.dtype)
    is_beyond = np.abs(nearest.astype(np.float64)) > np.abs(numbers)
    action[:] = np.where(is_beyond, np.nextafter(nearest, action.dtype.type(0)), nearest)


def packed_note(
    said: int,
    active: bytes,
    margins: Sequence[float],
    states: Sequence[int],
    since_ns: Sequence[int],
) -> bytes:
    """The facts after a step as bytes, with tasks only if the action was changed."""
    note = bytes([said]) + active + struct.pack(f"={len(margins)}d", *margins)
    if said & CHANGED:
        note += bytes(states) + struct.pack(f"={len(since_ns)}q", *since_ns)
    return note


class NativeRow:
    """Guards in a row, in their initial state. One call performs a step of all of them."""

    def __init__(
        self,
        library: NativeLibrary,
        count: int,
        machine: Machine,
        table_of: Callable[[Wiring], WiringTable],
    ) -> None:
        made = library.function("guards_new")(count)
        if library.is_null(made):
            raise MemoryError
        free = library.function("guards_free")
        self._first = library.owned(made, lambda first: free(first, count))
        self._library = library
        self._count = count
        self._shape = (count, len(machine.rules))
        self._margins = (count, len(margins_of(machine)))
        self._table_of = table_of
        self._table: WiringTable | None = None

    def connect(self, wiring: Wiring) -> None:
        """Use arrays of the sizes in a wiring from now on."""
        self._table = self._table_of(wiring)

    def step(
        self,
        which: NDArray[np.bool_] | None,
        times_ns: NDArray[np.int64] | None,
        observations: Floats | None,
        actions: Floats | None,
    ) -> tuple[int, NDArray[np.bool_], NDArray[np.bool_]]:
        """Perform a step at one instant, or at one instant for each guard. Actions are changed in
        place. None stands for all guards, for their present instants, for no observation, and for
        no decision.

        Returns the first row that refuses its instant (then nothing has changed), or the number of
        rows; a mask of the active rules, of shape (rows, rules); and a mask of the changed actions.
        """
        library = self._library
        active, changed = np.empty(self._shape, np.bool_), np.empty(self._count, np.bool_)
        done = library.function("guards_step")(
            self._first,
            self._count,
            self._wired.pointer,
            library.pointer(_BYTES, which),
            library.pointer("int64_t[]", times_ns),
            int(times_ns is not None and len(times_ns) != 1),
            library.pointer("double[]", observations),
            library.pointer("double[]", actions),
            library.pointer(_BYTES, active),
            library.pointer(_BYTES, changed),
        )
        return int(done), active, changed

    def allow(self, actions: Floats) -> tuple[int, NDArray[np.bool_]]:
        """The first row without an observation, or the number of rows; and, for each guard, which
        actions would pass unchanged, as a mask of shape (rows, actions).
        """
        library = self._library
        allowed = np.empty((self._count, len(actions)), np.bool_)
        done = library.function("guards_allow")(
            self._first,
            self._count,
            self._wired.pointer,
            library.pointer("double[]", actions),
            len(actions),
            library.pointer(_BYTES, allowed),
        )
        return int(done), allowed

    def margins(self) -> Floats:
        """The margins that rules declare, in SI units, of shape (rows, margins)."""
        library = self._library
        margins = np.empty(self._margins)
        call = library.function("guards_margins")
        call(self._first, self._count, library.pointer("double[]", margins))
        return margins

    def restart(self, which: NDArray[np.bool_]) -> None:
        """Let the marked guards forget everything."""
        call = self._library.function("guards_restart")
        call(self._first, self._count, self._library.pointer(_BYTES, which))

    @property
    def _wired(self) -> WiringTable:
        assert self._table is not None, "connected first"
        return self._table
