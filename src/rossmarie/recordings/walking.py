"""A walk through many encoded messages of one type at the same time, by their plan.

All messages complete a step before the next step begins. A message that does not fit the plan is
left behind, and rosbags has to decode it: it is damaged, or has a field without a step.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

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
from rossmarie.recordings.sheet import Sheet, SheetValues

_HEADER = 4
"""The bytes before a message in CDR: its encoding, and options."""
_ORDERS = {0: ">", 1: "<"}
"""The byte order of a message in CDR, by the mark of its encoding."""
_SLACK = 3
"""The most bytes that may follow a message in CDR."""
_COUNT = 4
"""The bytes of the length before a text or an array."""
_MOST_RECORDS = 256
"""The most texts or messages of an array in a walk, because each costs some steps of all
messages.
"""


def walk(
    plan: ReadPlan,
    texts: Mapping[bytes, float],
    content: bytes,
    starts: NDArray[np.int64],
    ends: NDArray[np.int64],
) -> SheetValues:
    """The results of the plan for messages; message i is `content[starts[i] : ends[i]]`. `texts`
    are the numbers of the texts that slots are compared with.
    """
    sheet = Sheet(plan, texts, content, len(starts))
    if not plan.is_cdr:
        _Group(sheet, "<", False, np.arange(len(starts)), starts, ends).go_to_end(plan.steps)
        return sheet.found()
    whole = np.flatnonzero(ends - starts >= _HEADER)
    encodings = sheet.numbers(">u2", starts[whole])
    for encoding, order in _ORDERS.items():
        rows = whole[encodings == encoding]
        if len(rows):
            places = starts[rows] + _HEADER
            _Group(sheet, order, True, rows, places, ends[rows]).go_to_end(plan.steps)
    return sheet.found()


class _Group:
    """Messages that walk together: their rows in the sheet, their present places and their ends. In
    CDR they are aligned relative to their starts.
    """

    def __init__(
        self,
        sheet: Sheet,
        order: str,
        is_cdr: bool,
        rows: NDArray[np.intp],
        places: NDArray[np.int64],
        ends: NDArray[np.int64],
    ) -> None:
        self._sheet = sheet
        self._order = order
        self._is_cdr = is_cdr
        self._rows = rows
        self._places = self._starts = places
        self._ends = ends

    def go_to_end(self, steps: Sequence[Step]) -> None:
        """Make all steps. Messages that end at the expected place are marked as completed."""
        self._go(steps)
        left = self._ends - self._places
        self._sheet.arrive(self._rows[(left >= 0) & (left <= (_SLACK if self._is_cdr else 0))])

    def _go(self, steps: Sequence[Step]) -> None:
        for step in steps:
            match step:
                case ByteStretch():
                    self._stretch(step)
                case TextBytes():
                    self._text(step)
                case NumberSequence():
                    self._numbers(step)
                case Records():
                    self._records(step)

    # --- steps -------------------------------------------------------------------------------

    def _stretch(self, step: ByteStretch) -> None:
        self._places = self._aligned(step.align)
        self._keep(self._places + step.size <= self._ends)
        for read in step.reads:
            places, kind = self._places + read.offset, self._order + read.kind
            match read:
                case StretchNumber(targets=targets):
                    self._sheet.fill(targets, self._rows, self._sheet.numbers(kind, places))
                case NumberArray(arrays=arrays, count=count):
                    counts = np.full(len(places), count)
                    self._sheet.fill_arrays(arrays, self._rows, kind, places, counts)
        self._places = self._places + step.size

    def _text(self, step: TextBytes) -> None:
        lengths = self._take_counts()
        ends = self._places + lengths
        (ends,) = self._keep(ends <= self._ends, ends)
        if self._is_cdr:  # a 0 ends the text
            (ends,) = self._keep(ends > self._places, ends)
            (ends,) = self._keep(self._sheet.numbers("u1", ends - 1) == 0, ends)
        stops = ends - 1 if self._is_cdr else ends
        if step.slots:
            values = self._sheet.texts(self._places, stops)
            is_text = ~np.isnan(values)
            for slot in step.slots:
                self._sheet.fill([SlotTarget(slot, SlotPart.ALL)], self._rows, values)
        else:
            is_text = self._sheet.are_texts(self._places, stops)
        self._places = ends
        self._keep(is_text)

    def _numbers(self, step: NumberSequence) -> None:
        counts = self._take_counts()
        self._places = np.where(counts > 0, self._aligned(step.align), self._places)
        ends = self._places + counts * step.size
        counts, ends = self._keep(ends <= self._ends, counts, ends)
        kind = self._order + step.kind
        for index, targets in step.elements.items():
            has = counts > index
            places = self._places[has] + index * step.size
            self._sheet.fill(targets, self._rows[has], self._sheet.numbers(kind, places))
        if step.arrays:
            self._sheet.fill_arrays(step.arrays, self._rows, kind, self._places, counts)
        self._places = ends

    def _records(self, step: Records) -> None:
        counts = self._take_counts()
        match step.others:
            case (ByteStretch(align=align, size=size),) if not step.elements:
                self._pass_over(counts, align, size)
            case _:  # open: any other steps
                (counts,) = self._keep(counts <= _MOST_RECORDS, counts)
                for index in range(int(counts.max(initial=0))):
                    steps = step.elements.get(index, step.others)
                    counts = self._go_with(counts > index, steps, counts)

    def _pass_over(self, counts: NDArray[np.int64], align: int, size: int) -> None:
        """Skip elements of one size from which nothing is read."""
        distance = -(-size // align) * align
        lengths = np.where(counts > 0, (counts - 1) * distance + size, 0)
        ends = np.where(counts > 0, self._aligned(align), self._places) + lengths
        (self._places,) = self._keep(ends <= self._ends, ends)

    def _go_with(
        self, chosen: NDArray[np.bool_], steps: Sequence[Step], counts: NDArray[np.int64]
    ) -> NDArray[np.int64]:
        """Make steps with some messages of the group, and drop the messages that are left behind.
        Returns the counts of the remaining messages.
        """
        columns = (column[chosen] for column in (self._rows, self._places, self._ends))
        some = _Group(self._sheet, self._order, self._is_cdr, *columns)
        some._starts = self._starts[chosen]
        some._go(steps)
        back = np.searchsorted(self._rows, some._rows)
        self._places = self._places.copy()
        self._places[back] = some._places
        stay = ~chosen
        stay[back] = True
        (counts,) = self._keep(stay, counts)
        return counts

    # --- places ------------------------------------------------------------------------------

    def _aligned(self, to: int) -> NDArray[np.int64]:
        """The next places at a multiple of `to` bytes from the start."""
        return self._places if to == 1 else self._places + (self._starts - self._places) % to

    def _take_counts(self) -> NDArray[np.int64]:
        """Read the lengths before texts or arrays, and step over them."""
        self._keep(self._places + _COUNT <= self._ends)
        counts = self._sheet.numbers(f"{self._order}u4", self._places).astype(np.int64)
        self._places = self._places + _COUNT
        return counts

    def _keep(
        self, good: NDArray[np.bool_], *columns: NDArray[np.int64]
    ) -> tuple[NDArray[np.int64], ...]:
        """Leave messages behind unless they are `good`, also in columns that belong to the
        group.
        """
        if good.all():
            return columns
        self._rows, self._places = self._rows[good], self._places[good]
        self._starts, self._ends = self._starts[good], self._ends[good]
        return tuple(column[good] for column in columns)
