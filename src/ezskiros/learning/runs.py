"""Runs: each trace with the verdicts of the same time. The time stamps pair them, not the file
names.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path
from typing import TypeVar

from dslkit.diagnostics import Collector, Diagnostic
from dslkit.source import SourceFile, Span
from ezskiros.learning.errors import NoRecord, RunAlone, RunTwice
from ezskiros.learning.records import RecordError, lines, read_text
from ezskiros.learning.traces import TaskTrace, is_event, read_trace
from ezskiros.learning.verdicts import Verdicts, is_header, read_verdicts

_MOST_FINDINGS = 10
"""The most reported runs without a partner. Usually they have one cause."""
_Record = TypeVar("_Record", TaskTrace, Verdicts)


@dataclass(frozen=True)
class TaskRun:
    """One task, and the activations of rules in its recording. A recording may have several
    tasks.
    """

    trace: TaskTrace
    verdicts: Verdicts


def read_runs(paths: Iterable[Path]) -> tuple[Sequence[TaskRun], Sequence[Diagnostic]]:
    """The runs of verdicts and traces in any order, and the findings. After a finding there are no
    runs. Raises `OSError` for a file that cannot be read.
    """
    collector = Collector()
    found = [_read(path) for path in dict.fromkeys(paths)]
    records = [each for each in found if not isinstance(each, Diagnostic)]
    collector.extend(each for each in found if isinstance(each, Diagnostic))
    if not collector.sorted():
        traces = [each for each in records if isinstance(each, TaskTrace)]
        verdicts = [each for each in records if isinstance(each, Verdicts)]
        collector.extend(_twice(traces, "traces"))
        collector.extend(_twice(verdicts, "verdicts"))
        collector.extend(_alone(traces, verdicts))
    if collector.sorted():
        return [], collector.sorted()
    runs = [TaskRun(trace, one) for trace in traces for one in verdicts if _is_shared(trace, one)]
    return runs, []


def _read(path: Path) -> TaskTrace | Verdicts | Diagnostic:
    """The record in a file, or the finding for an invalid file."""
    try:
        return _record(read_text(path))
    except RecordError as problem:
        return problem.diagnostic


def _record(file: SourceFile) -> TaskTrace | Verdicts:
    found = lines(file)
    first = next(found, None)
    if first is None:
        raise RecordError(NoRecord(path=file.path, reason="it is empty").at(Span(file, 0, 0)))
    if is_header(first):
        return read_verdicts(first, found)
    if not is_event(first):
        first.fail("its first line is neither the header of verdicts nor an event of a trace")
    return read_trace(first, found)


def _is_shared(one: TaskTrace | Verdicts, other: TaskTrace | Verdicts) -> bool:
    """Say whether the times of two files overlap."""
    return one.start_ns <= other.end_ns and other.start_ns <= one.end_ns


def _twice(records: Sequence[_Record], kind: str) -> Iterator[Diagnostic]:
    """Findings for files that overlap with a file before them."""
    in_order = sorted(records, key=lambda each: each.start_ns)
    longest: _Record | None = None
    for each in in_order:
        if longest is not None and _is_shared(longest, each):
            found = RunTwice(path=longest.file.path, other=each.file.path, kind=kind)
            yield found.at(Span(each.file, 0, 0))
        if longest is None or each.end_ns > longest.end_ns:
            longest = each


def _alone(traces: Sequence[TaskTrace], verdicts: Sequence[Verdicts]) -> Iterator[Diagnostic]:
    found = [
        *(_lonely(each, verdicts, "verdicts") for each in traces if not _has(each, verdicts)),
        *(_lonely(each, traces, "traces") for each in verdicts if not _has(each, traces)),
    ]
    yield from found[:_MOST_FINDINGS]


def _has(record: TaskTrace | Verdicts, others: Iterable[TaskTrace | Verdicts]) -> bool:
    return any(_is_shared(record, each) for each in others)


def _lonely(
    record: TaskTrace | Verdicts, others: Sequence[TaskTrace | Verdicts], kind: str
) -> Diagnostic:
    start, end = _spelled(record.start_ns), _spelled(record.end_ns)
    found = RunAlone(path=record.file.path, others=kind, start=start, end=end)
    nearest = min(others, key=lambda each: abs(each.start_ns - record.start_ns), default=None)
    notes = []
    if nearest is not None:
        start, end = _spelled(nearest.start_ns), _spelled(nearest.end_ns)
        notes.append(found.OtherClock(others=kind, start=start, end=end))
    return found.at(Span(record.file, 0, 0), notes=notes)


def _spelled(stamp_ns: int) -> str:
    """A stamp for readers: the time in UTC, to the millisecond."""
    try:
        moment = datetime.fromtimestamp(stamp_ns // 1_000_000 / 1000, timezone.utc)
    except (OverflowError, ValueError):
        return f"{stamp_ns} ns"
    return moment.strftime("%Y-%m-%d %H:%M:%S.") + f"{stamp_ns // 1_000_000 % 1000:03}"
