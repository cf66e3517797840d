"""Recordings as CSV: the time is in the first column, each other column is a field.

Columns are named after fields (`/imu/data.orientation.x`, `/scan.ranges[0]`), or after the inputs
of the rules (`speed`; `orientation.x` for the field `x` of the input `orientation`). Columns that
no rule reads are ignored.

A row updates each topic with at least one filled cell, all at the instant of the row; empty cells
of such a topic are NaN, which is unknown. The cells of some columns may contain any text: a filled
cell only shows that a message came. These columns are named after a topic, or after an input whose
rules use only its age. Rows are read in file order.

The time is in seconds. It is in nanoseconds if the column is called `time_ns`, or if its first
value is an integer of 15 digits or more. In seconds such a value would be in the far future; in
nanoseconds it is a ROS stamp.
"""

from __future__ import annotations

import csv
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import count
from pathlib import Path
from typing import TextIO

from dslkit.diagnostics import Collector
from dslkit.source import SourceFile, Span
from rossmarie.ir import Array, Batch, Machine, is_setting
from rossmarie.ir.beams import is_of_scan
from rossmarie.recordings.batches import batched
from rossmarie.recordings.clock import SEEN_BY_THE_MONITOR, Setbacks, stamps_of
from rossmarie.recordings.clouds import is_of_points
from rossmarie.recordings.csv_cells import ChannelReader, Clock, clock, unreadable_cells
from rossmarie.recordings.csv_columns import (
    SlotColumns,
    column_keys,
    duplicate_column,
    expected_column,
    match_columns,
    similar_column,
)
from rossmarie.recordings.elements import never_found
from rossmarie.recordings.errors import (
    ColumnMissing,
    ColumnRepeated,
    FieldNotRecorded,
    NothingToReplay,
    RecordingCorrupt,
    RecordingEmpty,
    RecordingError,
    RowsSkipped,
    TimeColumnMissing,
    TopicNeverSent,
    at_file,
)
from rossmarie.recordings.limits import LONGEST_LINE
from rossmarie.recordings.matching import (
    Match,
    channel_match,
    check_topic_map,
    field_text,
    input_span,
    kind_text,
    listed,
    with_reasons,
)
from rossmarie.recordings.model import FramesFound, Observe, RecordedTopic, Survey, Update

_DELIMITERS = ",;\t"
_SHOWN = 200
_MOST_STAMPS = 10_000
_MOST_PATTERNS = 1000
"""The most patterns of filled cells that are counted together."""


class CsvRecording:
    """A CSV file as a recording. Raises `RecordingError` if the file is no such table, or is
    empty.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        with path.open(encoding="utf-8-sig", errors="replace", newline="") as file:
            header, first = (file.readline(LONGEST_LINE + 1) for _ in range(2))
        self._delimiter = max(_DELIMITERS, key=header.count)
        self._names = [name.strip() for name in self._cells_of(header)]
        self._to_ns = self._clock(header, first)
        self._keys = column_keys(self._names)
        repeated = duplicate_column(self._names)
        if repeated is not None:
            span = self._header_span(header, self._names[repeated])
            raise RecordingError(ColumnRepeated(column=self._names[repeated]).at(span))
        self._survey()

    def batches(
        self, machine: Machine, collector: Collector, topic_map: Mapping[str, str]
    ) -> Iterator[Batch]:
        """See `Recording.batches`."""
        collector.extend(self.findings)
        check_topic_map(machine, topic_map)
        found = []
        for number, channel in enumerate(machine.channels):
            match = channel_match(machine, number, topic_map.get(channel.topic, channel.topic))
            found.append((match, match_columns(match, self._keys, machine)))
        read = {column for _, columns in found for column in columns.used()}
        unread = [name for column, name in enumerate(self._names) if column and column not in read]
        for match, columns in found:
            if not is_setting(machine.channels[match.channel]):
                self._report_missing(match, columns, unread, machine, collector)
        if not read and machine.channels:
            raise self._nothing_to_replay(machine, collector)
        readers = [self._reader(*pair, machine) for pair in found if pair[1].used()]
        return batched(machine, self._read(readers, machine, collector))

    def frames(self) -> FramesFound:
        """No frames: texts with frames are ordinary columns."""
        return FramesFound()

    def survey(self, observers: Mapping[str, Observe], seconds: float) -> Survey:
        """An empty survey: a table has no messages."""
        del observers, seconds
        return Survey()

    def definitions(self) -> Mapping[str, str]:
        """No definitions: a table has no types."""
        return {}

    def close(self) -> None:
        """Do nothing: no file is open."""

    def __enter__(self) -> CsvRecording:
        """Return the recording itself."""
        return self

    def __exit__(self, *reason: object) -> None:
        """Do nothing: no file is open."""

    def _reader(self, match: Match, columns: SlotColumns, machine: Machine) -> ChannelReader:
        names = [self._names[column] for column in columns.used()]
        filled = sum(self._filled[column] for column in columns.used())
        unreadable = unreadable_cells(match, names, filled, self.start_ns, machine)
        return ChannelReader(match, columns, machine, self._names, unreadable)

    def _report_missing(
        self,
        match: Match,
        columns: SlotColumns,
        unread: Sequence[str],
        machine: Machine,
        collector: Collector,
    ) -> None:
        """Report the inputs without all their columns; `unread` are the columns that may be
        misspelt.
        """
        is_blank = bool(columns.used()) and not any(self._filled[i] for i in columns.used())
        reported: set[str] = set()
        for reader in match.inputs:
            span = input_span(machine, reader)
            read = match.fields_of(reader)
            missing = [
                field
                for field in columns.missing
                if field.input == reader and expected_column(match, field, machine) not in reported
            ]
            if any(isinstance(field, Array) and is_of_points(field) for field in missing):
                collector.add(self._no_points(match).at(span, help=FieldNotRecorded.Points()))
                continue
            if any(isinstance(field, Array) and is_of_scan(field) for field in missing):
                collector.add(self._no_beams(match).at(span, help=FieldNotRecorded.Beams()))
                continue
            wanted = [expected_column(match, field, machine) for field in missing]
            reported.update(wanted)
            if not match.slots and not match.arrays and columns.arrival is None:
                wanted = [machine.inputs[reader].name]
            if wanted and len(missing) == len(read):
                near = similar_column(match, missing, machine, unread)
                finding = ColumnMissing(
                    input=machine.inputs[reader].name,
                    unread=listed(unread, none="no other column"),
                    expected=listed(wanted),
                )
                help = finding.Near(near=near[0], expected=near[1]) if near else None
                collector.add(finding.at(span, help=help))
                continue
            for field, name in zip(missing, wanted, strict=True):
                text, kind = field_text(field.path), kind_text(field)
                reason = f"`{self.path.name}` has no column for it"
                lost = FieldNotRecorded(topic=match.topic, field=text, kind=kind, reason=reason)
                collector.add(lost.at(span, help=lost.NoColumn(column=name)))
            if is_blank:
                collector.add(TopicNeverSent(topic=match.topic).at(span))

    def _no_points(self, match: Match) -> FieldNotRecorded:
        kind, reason = "the points of a cloud", "the points of a cloud are bytes"
        return FieldNotRecorded(topic=match.topic, field="points", kind=kind, reason=reason)

    def _no_beams(self, match: Match) -> FieldNotRecorded:
        kind, reason = "the beams of a scan", "only a whole scan contains their angles"
        return FieldNotRecorded(topic=match.topic, field="ranges", kind=kind, reason=reason)

    def _nothing_to_replay(self, machine: Machine, collector: Collector) -> RecordingError:
        finding = NothingToReplay(
            expected="the inputs " + listed(declared.name for declared in machine.inputs),
            recorded="the columns " + listed(self._names[1:], none="(none)"),
        )
        return with_reasons(at_file(finding, self.path), collector, help=finding.Columns())

    def _read(
        self, readers: Sequence[ChannelReader], machine: Machine, collector: Collector
    ) -> Iterator[Update]:
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
            topic = machine.channels[reader.channel].topic
            for search in reader.never_found:
                collector.add(never_found(topic, search, machine))

    def _rows(self) -> Iterator[tuple[int | None, list[str]]]:
        """The instant and the cells of each row. The instant is None if it is missing or not
        valid.
        """
        width = len(self._names)
        with self.path.open(encoding="utf-8-sig", errors="replace", newline="") as file:
            rows = csv.reader(self._lines(file), delimiter=self._delimiter, skipinitialspace=True)
            try:
                next(rows)
                for cells in rows:
                    if cells:
                        yield (self._to_ns(cells[0]) if len(cells) == width else None), cells
            except csv.Error as error:
                raise self._not_csv(rows.line_num, error) from error

    def _lines(self, file: TextIO) -> Iterator[str]:
        """The lines of the file. Raises `RecordingError` before a line takes too much memory."""
        for number in count(1):
            line = file.readline(LONGEST_LINE + 1)
            if len(line) > LONGEST_LINE:
                reason = f"line {number} is longer than {LONGEST_LINE >> 20} MiB"
                raise RecordingError(at_file(RecordingCorrupt(reason=reason), self.path))
            if not line:
                return
            yield line.replace("\0", "\N{REPLACEMENT CHARACTER}")

    def _cells_of(self, line: str) -> list[str]:
        try:
            return next(csv.reader([line], delimiter=self._delimiter), [])
        except csv.Error as error:
            raise self._not_csv(1, error) from error

    def _not_csv(self, line: int, error: csv.Error) -> RecordingError:
        reason = f"line {line}: {error}; is a closing quotation mark missing?"
        return RecordingError(at_file(RecordingCorrupt(reason=reason), self.path))

    def _clock(self, header: str, first: str) -> Clock:
        """The conversion of the first column."""
        name = self._names[0] if self._names else ""
        found = clock(name, first.split(self._delimiter, 1)[0])
        if found is None:
            raise RecordingError(TimeColumnMissing().at(self._header_span(header, name)))
        return found

    def _header_span(self, header: str, name: str) -> Span:
        """The last place of a name in the first line, if it can be shown."""
        source = SourceFile(str(self.path), header[:_SHOWN].rstrip("\r\n"))
        start = max(source.text.rfind(name), 0)
        return Span(source, start, min(start + len(name), len(source.text)))

    def _survey(self) -> None:
        """Count the filled cells of each column, find the first and the last instant, and find out
        whether time goes back.
        """
        patterns: Counter[tuple[bool, ...]] = (
            Counter()
        )  # most rows fill the same cells as other rows
        self._filled: Counter[int] = Counter()
        rows: Counter[str] = Counter()
        total = 0
        instants: list[int] = []  # the first and the last instant, in file order
        stamps: list[int] = []
        skipped: Counter[str] = Counter()
        setbacks = Setbacks(tolerance_ns=0)
        for number, (at_ns, cells) in enumerate(self._rows(), start=2):
            if at_ns is None:
                skipped[self._reason_to_skip(number, cells) if not skipped else ""] += 1
                continue
            instants[1:] = [at_ns]
            stamps.append(at_ns)
            total += 1
            if len(stamps) == _MOST_STAMPS:
                setbacks.note("", stamps_of(stamps))
                stamps.clear()
            patterns[tuple(map(bool, cells))] += 1
            if len(patterns) > _MOST_PATTERNS:
                self._count_filled(patterns, rows)
                patterns.clear()
        if not instants:
            raise RecordingError(at_file(RecordingEmpty(reason="it has no rows"), self.path))
        if stamps:
            setbacks.note("", stamps_of(stamps))
        self.start_ns, self.end_ns = instants[0], instants[-1]
        self._count_filled(patterns, rows)
        named = sorted({topic for name in self._names[1:] if (topic := _topic_of(name))})
        self.topics: Mapping[str, RecordedTopic] = {
            name: RecordedTopic(name, None, rows[name]) for name in named
        }
        self.findings = setbacks.findings(SEEN_BY_THE_MONITOR, self.path)
        if skipped:
            lost = skipped.total()
            reason = next(iter(skipped))
            finding = RowsSkipped(count=lost, total=lost + total, reason=reason)
            self.findings = (at_file(finding, self.path), *self.findings)

    def _count_filled(self, patterns: Mapping[tuple[bool, ...], int], rows: Counter[str]) -> None:
        """Count how often each column is filled, and how many rows update each topic."""
        topics = [_topic_of(name) for name in self._names]
        for pattern, times in patterns.items():
            filled = [column for column, is_filled in enumerate(pattern) if is_filled]
            self._filled.update(dict.fromkeys(filled, times))
            rows.update(dict.fromkeys({topics[column] for column in filled}, times))

    def _reason_to_skip(self, number: int, cells: Sequence[str]) -> str:
        if len(cells) != len(self._names):
            return f"row {number} has {len(cells)} cells, the header {len(self._names)}"
        return f"row {number} starts with `{cells[0][:40]}`, which is not an instant"


def _topic_of(name: str) -> str:
    return name.partition(".")[0] if name.startswith("/") else ""
