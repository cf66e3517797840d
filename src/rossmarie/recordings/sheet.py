"""The results of a walk through many messages: a column for each slot, and the arrays."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rossmarie.recordings.gathering import values_at
from rossmarie.recordings.plan import ReadPlan, SlotPart, SlotTarget

_SHORT = 64
"""The longest texts, in bytes, that are compared all at once."""
_OTHER_TEXT = -1.0
_NOTHING: NDArray[np.generic] = np.empty(0)


@dataclass(frozen=True, eq=False)
class SheetValues:
    """A value for each message. `is_done` marks the messages that the walk has completed; the
    values of other messages are unknown.
    """

    is_done: NDArray[np.bool_]
    slots: Mapping[int, NDArray[np.float64]]
    arrays: Mapping[int, list[NDArray[np.generic] | None]]


def nothing_found(count: int, slots: Iterable[int], arrays: Iterable[int]) -> SheetValues:
    """The results without a walk."""
    return SheetValues(
        np.zeros(count, np.bool_),
        {slot: np.full(count, np.nan) for slot in slots},
        {array: [_NOTHING] * count for array in arrays},
    )


class Sheet:
    """Reads from the content of `count` messages, and stores the results. `texts` are the numbers
    of the texts that slots are compared with.
    """

    def __init__(
        self, plan: ReadPlan, texts: Mapping[bytes, float], content: bytes, count: int
    ) -> None:
        self._plan = plan
        self._texts = texts
        self._content = content
        self._done = np.zeros(count, np.bool_)
        self._columns: dict[SlotTarget, NDArray[np.float64]] = {}
        self._arrays: dict[int, list[NDArray[np.generic] | None]] = {
            array: [_NOTHING] * count for array in plan.arrays
        }

    # --- reading -----------------------------------------------------------------------------

    def numbers(self, kind: str, places: NDArray[np.int64]) -> NDArray[np.generic]:
        """The numbers at some places. All places are inside the content."""
        stored, is_flag = _stored_as(kind)
        found = values_at(self._content, stored, places)
        return found != 0 if is_flag else found

    def are_texts(self, starts: NDArray[np.int64], ends: NDArray[np.int64]) -> NDArray[np.bool_]:
        """For each stretch, whether it is a text in UTF-8."""
        lengths = ends - starts
        if len(lengths) and lengths[0] <= _SHORT and np.all(lengths == lengths[0]):
            letters = self.numbers(f"V{lengths[0]}", starts) if lengths[0] else _NOTHING
            is_plain = letters.view(np.uint8).reshape(len(starts), -1) < 0x80
            if is_plain.all():
                return np.ones(len(starts), np.bool_)
        return ~np.isnan(self.texts(starts, ends))

    def texts(self, starts: NDArray[np.int64], ends: NDArray[np.int64]) -> NDArray[np.float64]:
        """The numbers of some texts; NaN for a text that is not in UTF-8."""
        places = zip(starts.tolist(), ends.tolist(), strict=True)
        pieces = [self._content[start:end] for start, end in places]
        known = {piece: self._number(piece) for piece in set(pieces)}
        return np.array([known[piece] for piece in pieces], np.float64)

    def _number(self, piece: bytes) -> float:
        try:
            piece.decode()
        except UnicodeDecodeError:
            return math.nan
        return self._texts.get(piece, _OTHER_TEXT)

    # --- keeping -----------------------------------------------------------------------------

    def fill(
        self, targets: Sequence[SlotTarget], rows: NDArray[np.intp], values: NDArray[np.generic]
    ) -> None:
        """Store a number for each of some messages."""
        with np.errstate(invalid="ignore"):  # all kinds of NaN become the same NaN
            for target in targets:
                self._column(target)[rows] = values

    def fill_arrays(
        self,
        arrays: Sequence[int],
        rows: NDArray[np.intp],
        kind: str,
        places: NDArray[np.int64],
        counts: NDArray[np.int64],
    ) -> None:
        """Store an array for each of some messages."""
        stored, is_flag = _stored_as(kind)
        columns = (column.tolist() for column in (rows, places, counts))
        for row, place, count in zip(*columns, strict=True):
            found = np.frombuffer(self._content, stored, count, place)
            for array in arrays:
                self._arrays[array][row] = found != 0 if is_flag else found

    def arrive(self, rows: NDArray[np.intp]) -> None:
        """Mark messages as completed."""
        self._done[rows] = True

    def found(self) -> SheetValues:
        """The results for the completed messages."""
        slots = {slot: self._slot(slot) for slot in self._plan.slots}
        slots |= {slot: self._text(slot) for slot in self._plan.texts}
        left_behind = np.flatnonzero(~self._done)
        for column in slots.values():
            column[left_behind] = np.nan
        for filled in self._arrays.values():
            for row in left_behind.tolist():
                filled[row] = _NOTHING
        return SheetValues(self._done, slots, self._arrays)

    def _column(self, target: SlotTarget) -> NDArray[np.float64]:
        if target not in self._columns:
            self._columns[target] = np.full(len(self._done), np.nan)
        return self._columns[target]

    def _slot(self, slot: int) -> NDArray[np.float64]:
        seconds = SlotTarget(slot, SlotPart.SECONDS)
        if seconds in self._columns:
            return (
                self._columns[seconds] + self._column(SlotTarget(slot, SlotPart.NANOSECONDS)) * 1e-9
            )
        return self._column(SlotTarget(slot, SlotPart.ALL))

    def _text(self, slot: int) -> NDArray[np.float64]:
        """The texts of a slot. If an array is too short to contain the text, the text counts as
        another text.
        """
        column = self._column(SlotTarget(slot, SlotPart.ALL))
        column[np.isnan(column)] = _OTHER_TEXT
        return column


def _stored_as(kind: str) -> tuple[str, bool]:
    """The form in which a number is stored, and whether it is a flag. Every flag except 0 is
    true.
    """
    return ("u1", True) if kind.endswith("?") else (kind, False)
