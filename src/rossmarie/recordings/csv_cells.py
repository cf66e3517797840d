"""The cells of a CSV file, as instants and values.

Numbers have the usual notation of other programs, not Python's own (`1_000`). An unreadable cell is
NaN, and is counted.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from decimal import Decimal

from rossmarie.ir import (
    EARLIEST_NS,
    FLAG_LIMITS,
    LATEST_NS,
    Array,
    ChannelValues,
    FieldKind,
    Listed,
    Machine,
)
from rossmarie.recordings.csv_columns import SlotColumns
from rossmarie.recordings.elements import ElementSearch
from rossmarie.recordings.errors import MessagesUnreadable
from rossmarie.recordings.matching import Match, Unreadable, input_span, listed

_SECONDS = ("time", "t", "stamp")
_NANOSECONDS = "time_ns"
_STAMP_DIGITS = 15
_FLAGS = {"true": 1.0, "false": 0.0, "1": 1.0, "0": 0.0, "1.0": 1.0, "0.0": 0.0}
_SHOWN = 40

Clock = Callable[[str], int | None]
"""The conversion of a cell of the first column to nanoseconds; None if the cell is not an
instant.
"""


def clock(name: str, first: str) -> Clock | None:
    """The conversion for a first column with this name; None if the column does not contain the
    time.

    `first` is its first cell. If it has 15 digits, it is not in seconds: the instant would be in
    the far future.
    """
    if name.lower() == _NANOSECONDS:
        return lambda cell: _nanoseconds(cell, 1)
    if name.lower() not in _SECONDS:
        return None
    start = first.strip()
    is_stamp = start.isdigit() and len(start) >= _STAMP_DIGITS
    scale = 1 if is_stamp else 1_000_000_000
    return lambda cell: _nanoseconds(cell, scale)


def _nanoseconds(cell: str, scale: int) -> int | None:
    if "_" in cell:
        return None
    try:
        exact = Decimal(cell.strip()) * scale
    except ArithmeticError:  # not a number, or too large even for a Decimal
        return None
    instant = int(exact) if exact.is_finite() and exact.adjusted() < 20 else LATEST_NS
    return instant if EARLIEST_NS < instant < LATEST_NS else None


class ChannelReader:
    """Reads the cells of one channel; `names` are the names of all columns of the file."""

    def __init__(
        self,
        match: Match,
        columns: SlotColumns,
        machine: Machine,
        names: Sequence[str],
        unreadable: Unreadable,
    ) -> None:
        self.channel = match.channel
        self.unreadable = unreadable
        self._used = columns.used()
        self._names = names
        kinds = {index: match.slots[index].kind for index in columns.slots}
        self._numbers = {i: c for i, c in columns.slots.items() if kinds[i] is FieldKind.REAL}
        self._flags = {i: c for i, c in columns.slots.items() if kinds[i] is FieldKind.FLAG}
        self._texts = {i: c for i, c in columns.slots.items() if kinds[i] is FieldKind.TEXT}
        self._arrays = columns.arrays
        self._listed = columns.listed
        self._searches = {index: ElementSearch(match.slots[index]) for index in columns.listed}
        of_lists = {i: array.list for i, array in match.arrays.items() if array.list is not None}
        firsts = {its_list: index for index, its_list in reversed(of_lists.items())}
        self._owners = {i: firsts[of_lists[i]] if i in of_lists else i for i in match.arrays}
        self._readers = {index: self._reader(array) for index, array in match.arrays.items()}
        self._text_numbers = {text: float(number) for number, text in enumerate(machine.texts)}

    def read(self, at_ns: int, cells: Sequence[str]) -> ChannelValues | None:
        """The values in a row; None if all cells of this channel are blank."""
        if not any(cells[column] for column in self._used):
            return None
        slots = {i: self._number(at_ns, cells, column) for i, column in self._numbers.items()}
        for index, column in self._flags.items():
            slots[index] = self._flag(at_ns, cells, column)
        for index, column in self._texts.items():
            slots[index] = self._text(cells, column)
        for index, columns in self._listed.items():
            slots[index] = self._listed_number(at_ns, cells, columns, self._searches[index])
        return ChannelValues(slots, self._elements(at_ns, cells))

    @property
    def never_found(self) -> Iterator[ElementSearch]:
        """The elements that no row has contained so far, although some rows contained other
        elements.
        """
        return (each for each in self._searches.values() if each.is_vain)

    def _listed_number(
        self, at_ns: int, cells: Sequence[str], columns: Sequence[int], search: ElementSearch
    ) -> float:
        element = search.slot.path[-1]
        assert isinstance(element, Listed), "its columns are those of an array"
        filled = _filled(cells, columns)
        place = search.place(element, (), len(filled)) if filled else None
        if place is None:
            return math.nan
        read = self._flag if search.slot.kind is FieldKind.FLAG else self._number
        return read(at_ns, cells, filled[place])

    def _elements(self, at_ns: int, cells: Sequence[str]) -> dict[int, list[float]]:
        """The elements of each array, up to the last filled element. In a list, an element is
        filled if any of its fields is.
        """
        lengths: dict[int, int] = {}
        for index, columns in self._arrays.items():
            owner = self._owners[index]
            lengths[owner] = max(len(_filled(cells, columns)), lengths.get(owner, 0))
        arrays = {}
        for index, columns in self._arrays.items():
            read = self._readers[index]
            length = lengths[self._owners[index]]
            arrays[index] = [read(at_ns, cells, column) for column in columns[:length]]
        return arrays

    def _reader(self, array: Array) -> Callable[[int, Sequence[str], int], float]:
        """The reader of a cell of an array. Lists may contain texts, and flags as words."""
        if array.kind is FieldKind.TEXT:
            return lambda _, cells, column: self._text(cells, column)
        is_of_flags = array.list is not None and array.limits == FLAG_LIMITS
        return self._flag if is_of_flags else self._number

    def _text(self, cells: Sequence[str], column: int) -> float:
        text = cells[column].strip()
        return self._text_numbers.get(text, -1.0) if text else math.nan

    def _number(self, at_ns: int, cells: Sequence[str], column: int) -> float:
        cell = cells[column]
        try:
            if "_" not in cell:
                return float(cell)
        except ValueError:
            if not cell.strip():
                return math.nan
        return self._bad(at_ns, cells, column, "is not a number")

    def _flag(self, at_ns: int, cells: Sequence[str], column: int) -> float:
        text = cells[column].strip().lower()
        if not text or text in _FLAGS:
            return _FLAGS.get(text, math.nan)
        return self._bad(at_ns, cells, column, "is not `true`, `false`, `1` or `0`")

    def _bad(self, at_ns: int, cells: Sequence[str], column: int, reason: str) -> float:
        text = cells[column].strip()[:_SHOWN]
        self.unreadable.note(at_ns, f"`{text}` in the column `{self._names[column]}` {reason}")
        return math.nan


def _filled(cells: Sequence[str], columns: Sequence[int]) -> Sequence[int]:
    """The columns of an array up to the last filled column."""
    return columns[: max((i + 1 for i, each in enumerate(columns) if cells[each]), default=0)]


def unreadable_cells(
    match: Match, used: Sequence[str], filled: int, start_ns: int, machine: Machine
) -> Unreadable:
    """A count of the unreadable cells. `used` are the names of the columns of a channel, and
    `filled` is the number of their filled cells.
    """
    columns = "column" if len(used) == 1 else "columns"
    return Unreadable(
        what=f"values in the {columns} {listed(used)}",
        total=filled,
        start_ns=start_ns,
        spans=[input_span(machine, reader) for reader in match.inputs],
        help=MessagesUnreadable.Cells(),
    )
