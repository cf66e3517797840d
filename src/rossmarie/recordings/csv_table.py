"""Recordings as CSV: the time in the first column, a field in each of the others.

Columns are named after fields (`/imu/data.orientation.x`, `/scan.ranges[0]`), or after the inputs
of the rules (`speed`; `orientation.x` for the field `x` of the input `orientation`). Columns that
no rule reads are passed over.

A row updates each topic of which at least one cell is filled, all at the instant of the row; other
cells of such a topic are NaN, which is unknown. Rows are taken in the order of the file.

The time is in seconds, or in nanoseconds if the column is called `time_ns` or its first value is an
integer of 15 digits or more: as seconds that would be in the far future, as nanoseconds it is a
ROS stamp.
"""

from __future__ import annotations

import csv
import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from decimal import Decimal, InvalidOperation
from pathlib import Path

from dslkit.diagnostics import Collector, Diagnostic
from dslkit.source import SourceFile, Span
from rossmarie.ir import EARLIEST_NS, LATEST_NS, ChannelValues, Kind, Machine
from rossmarie.recordings.csv_columns import Columns, column_keys, match_columns
from rossmarie.recordings.errors import (
    FieldNotRecorded,
    RecordingEmpty,
    RecordingError,
    RowsSkipped,
    TimeColumnMissing,
    TopicNeverSent,
    TopicNotRecorded,
    at_file,
)
from rossmarie.recordings.matching import (
    Match,
    Unreadable,
    channel_match,
    check_topic_map,
    field_text,
    input_span,
    kind_text,
    listed,
    nothing_to_replay,
)
from rossmarie.recordings.model import Topic, Update

_SECONDS = ("time", "t", "stamp")
_NANOSECONDS = "time_ns"
_STAMP_DIGITS = 15
_DELIMITERS = ",;\t"
_FLAGS = {"true": 1.0, "false": 0.0}


class CsvRecording:
    """A CSV file as a recording. Raises `RecordingError` if it is not one, or is empty."""

    def __init__(self, path: Path) -> None:
        self.path = path
        with path.open(encoding="utf-8-sig", errors="replace", newline="") as file:
            header = file.readline()
            first = file.readline()
        self._delimiter = max(_DELIMITERS, key=header.count)
        names = next(csv.reader([header], delimiter=self._delimiter), [])
        self._names = [name.strip() for name in names]
        self._keys = column_keys(self._names)
        self._to_ns = self._clock(header, first)
        self._survey()

    def updates(
        self, machine: Machine, collector: Collector, topic_map: Mapping[str, str]
    ) -> Iterator[Update]:
        """See `Recording.updates`."""
        collector.extend(self.findings)
        check_topic_map(machine, topic_map)
        readers = []
        for number, channel in enumerate(machine.channels):
            match = channel_match(machine, number, topic_map.get(channel.topic, channel.topic))
            columns = match_columns(match, self._keys, machine)
            self._report_missing(match, columns, machine, collector)
            if columns.used():
                readers.append(_ChannelReader(match, columns, machine, self))
        if not readers and machine.channels:
            raise nothing_to_replay(self.topics, machine, self.path, collector)
        return self._read(readers, collector)

    def close(self) -> None:
        """Nothing is held open."""

    def __enter__(self) -> CsvRecording:
        """The recording itself."""
        return self

    def __exit__(self, *reason: object) -> None:
        """Nothing is held open."""

    def filled(self, column: int) -> int:
        """In how many rows a column is filled."""
        return self._filled[column]

    def _report_missing(
        self, match: Match, columns: Columns, machine: Machine, collector: Collector
    ) -> None:
        reason = f"`{self.path.name}` has no column for it"
        is_blank = bool(columns.used()) and not any(map(self.filled, columns.used()))
        for reader in match.inputs:
            span = input_span(machine, reader)
            read = match.fields_of(reader)
            missing = [field for field in columns.missing if field.input == reader]
            if read and len(missing) == len(read):
                recorded = listed(self._names[1:])
                collector.add(TopicNotRecorded(topic=match.topic, recorded=recorded).at(span))
                continue
            for field in missing:
                text, kind = field_text(field.path), kind_text(field)
                finding = FieldNotRecorded(topic=match.topic, field=text, kind=kind, reason=reason)
                collector.add(finding.at(span))
            if is_blank:
                collector.add(TopicNeverSent(topic=match.topic).at(span))

    def _read(self, readers: Sequence[_ChannelReader], collector: Collector) -> Iterator[Update]:
        for at_ns, cells in self._rows():
            if at_ns is None:
                continue
            channels = {}
            for reader in readers:
                values = reader.read(at_ns, cells)
                if values is not None:
                    channels[reader.channel] = values
            if channels:
                yield Update(at_ns, channels)
        for reader in readers:
            reader.unreadable.report(collector)

    def _rows(self) -> Iterator[tuple[int | None, list[str]]]:
        """Instant and cells of each row; no instant if it does not have one or does not fit."""
        width = len(self._names)
        with self.path.open(encoding="utf-8-sig", errors="replace", newline="") as file:
            lines = (line.replace("\0", "\N{REPLACEMENT CHARACTER}") for line in file)
            rows = csv.reader(lines, delimiter=self._delimiter, skipinitialspace=True)
            next(rows)
            for cells in rows:
                if cells:
                    yield (self._to_ns(cells[0]) if len(cells) == width else None), cells

    def _clock(self, header: str, first: str) -> Callable[[str], int | None]:
        """The conversion of the first column."""
        name = self._names[0].lower() if self._names else ""
        if name == _NANOSECONDS:
            return lambda cell: _nanoseconds(cell, 1)
        if name not in _SECONDS:
            end = len(self._names[0]) if self._names else 0
            source = SourceFile(str(self.path), header[:200].rstrip("\r\n"))
            raise RecordingError(TimeColumnMissing().at(Span(source, 0, min(end, 200))))
        start = first.split(self._delimiter, 1)[0].strip()
        is_stamp = start.isdigit() and len(start) >= _STAMP_DIGITS
        scale = 1 if is_stamp else 1_000_000_000
        return lambda cell: _nanoseconds(cell, scale)

    def _survey(self) -> None:
        """Count the filled cells of each column, and find the first and the last instant."""
        patterns: Counter[tuple[bool, ...]] = Counter()  # most rows fill the same cells as others
        start_ns, end_ns = LATEST_NS, EARLIEST_NS
        skipped: Counter[str] = Counter()
        for number, (at_ns, cells) in enumerate(self._rows(), start=2):
            if at_ns is None:
                skipped[self._reason_to_skip(number, cells) if not skipped else ""] += 1
                continue
            start_ns, end_ns = min(start_ns, at_ns), max(end_ns, at_ns)
            patterns[tuple(map(bool, cells))] += 1
        if start_ns > end_ns:
            raise RecordingError(at_file(RecordingEmpty(reason="it has no rows"), self.path))
        self.start_ns, self.end_ns = start_ns, end_ns
        self._count_filled(patterns)
        count = skipped.total()
        total = count + patterns.total()
        rows = RowsSkipped(count=count, total=total, reason=next(iter(skipped), ""))
        self.findings: tuple[Diagnostic, ...] = (at_file(rows, self.path),) if skipped else ()

    def _count_filled(self, patterns: Mapping[tuple[bool, ...], int]) -> None:
        """How often each column is filled, and how many rows say something about each topic."""
        topics = [_topic_of(name) for name in self._names]
        self._filled: Counter[int] = Counter()
        rows: Counter[str] = Counter()
        for pattern, count in patterns.items():
            filled = [column for column, is_filled in enumerate(pattern) if is_filled]
            self._filled.update(dict.fromkeys(filled, count))
            rows.update(dict.fromkeys({topics[column] for column in filled}, count))
        named = sorted({topic for topic in topics[1:] if topic})
        self.topics: Mapping[str, Topic] = {name: Topic(name, None, rows[name]) for name in named}

    def _reason_to_skip(self, number: int, cells: Sequence[str]) -> str:
        if len(cells) != len(self._names):
            return f"row {number} has {len(cells)} cells, the header {len(self._names)}"
        return f"row {number} starts with `{cells[0][:40]}`, which is no instant"


def _nanoseconds(cell: str, scale: int) -> int | None:
    try:
        exact = Decimal(cell.strip()) * scale
        instant = int(exact) if exact.is_finite() and exact.adjusted() < 20 else LATEST_NS
    except InvalidOperation:
        return None
    return instant if EARLIEST_NS < instant < LATEST_NS else None


# --- cells -----------------------------------------------------------------------------------


class _ChannelReader:
    """Reads the cells of one channel."""

    def __init__(
        self, match: Match, columns: Columns, machine: Machine, recording: CsvRecording
    ) -> None:
        self.channel = match.channel
        spans = [input_span(machine, reader) for reader in match.inputs]
        self._used = columns.used()
        filled = sum(recording.filled(column) for column in self._used)
        self.unreadable = Unreadable(
            match.topic, filled, recording.start_ns, "is unknown there", spans
        )
        kinds = {index: match.slots[index].kind for index in columns.slots}
        self._numbers = {i: c for i, c in columns.slots.items() if kinds[i] is not Kind.TEXT}
        self._texts = {i: c for i, c in columns.slots.items() if kinds[i] is Kind.TEXT}
        self._arrays = columns.arrays
        self._text_numbers = {text: float(number) for number, text in enumerate(machine.texts)}

    def read(self, at_ns: int, cells: Sequence[str]) -> ChannelValues | None:
        """What a row says; None if all cells of this channel are blank."""
        if not any(cells[column] for column in self._used):
            return None
        try:
            slots = {index: float(cells[column]) for index, column in self._numbers.items()}
        except ValueError:
            slots = {i: self._number(at_ns, cells[column]) for i, column in self._numbers.items()}
        for index, column in self._texts.items():
            text = cells[column].strip()
            slots[index] = self._text_numbers.get(text, -1.0) if text else math.nan
        return ChannelValues(slots, self._elements(at_ns, cells))

    def _elements(self, at_ns: int, cells: Sequence[str]) -> dict[int, list[float]]:
        """The elements of each array, up to the last one that is filled."""
        arrays = {}
        for index, columns in self._arrays.items():
            length = max((i + 1 for i, column in enumerate(columns) if cells[column]), default=0)
            arrays[index] = [self._number(at_ns, cells[column]) for column in columns[:length]]
        return arrays

    def _number(self, at_ns: int, cell: str) -> float:
        try:
            return float(cell)
        except ValueError:
            text = cell.strip()
            if text and text.lower() not in _FLAGS:
                self.unreadable.note(at_ns, f"`{text[:40]}` is not a number")
            return _FLAGS.get(text.lower(), math.nan)


def _topic_of(name: str) -> str:
    return name.partition(".")[0] if name.startswith("/") else ""
