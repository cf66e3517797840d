"""Coverage of a rules file by recordings, and the margins of its thresholds."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from dslkit.diagnostics import Collector, Diagnostic
from dslkit.source import SourceFile
from rossmarie.driver.pipeline import compile_file
from rossmarie.driver.sources import hashed_files, hashed_sources
from rossmarie.engines.python_monitor import PythonMonitor
from rossmarie.ir import Machine, Verdict
from rossmarie.recordings.batches import begun_together, updates_in
from rossmarie.recordings.model import Update
from rossmarie.recordings.opening import open_recording
from rossmarie.report.safety import EvidenceKind, evidence_text
from rossmarie.report.safety.exercised import coverage_results
from rossmarie.report.spare import spares
from rossmarie.targets import python
from rossmarie.testing.cone import cone_of, reported_by
from rossmarie.testing.coverage import Coverage, Watcher
from rossmarie.testing.goals import TraceGoal
from rossmarie.testing.history import History
from rossmarie.testing.margins import (
    MovableThreshold,
    Replay,
    ThresholdMargin,
    Verdicts,
    margin,
    thresholds,
)
from rossmarie.testing.places import compared_with_constants, seen_by
from rossmarie.testing.play import InstantEvents
from rossmarie.testing.unreachable import unreachable

Progress = Callable[[float], None]
"""Called from time to time with the completed share of the work, from 0 to 1."""


@dataclass(frozen=True)
class Exercised:
    """The covered goals, the reasons why some goals cannot be reached, the margin of each
    threshold, and the findings on rules and recordings. `sources` are the files of the rules.
    `length_ns` is the total length of the recordings.
    """

    coverage: Coverage
    reasons: Mapping[TraceGoal, str]
    margins: tuple[ThresholdMargin, ...]
    findings: tuple[Diagnostic, ...]
    sources: tuple[SourceFile, ...]
    length_ns: int


@dataclass(frozen=True)
class Trace:
    """A recording as the updates of a monitor."""

    updates: tuple[Update, ...]
    end_ns: int


def cover_recordings(
    rules: Path,
    recordings: Sequence[Path],
    *,
    topic_map: Mapping[str, str],
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
    on_progress: Progress = lambda _: None,
) -> Exercised:
    """Read recordings and compute their common coverage. Raises `RulesError`, and `RecordingError`
    if a recording has no readable messages.
    """
    compiled = compile_file(rules, systems=systems, message_folders=message_folders)
    machine = compiled.machine
    collector = Collector()
    traces = [
        trace_of(machine, path, compiled.message_folders, topic_map, collector)
        for path in recordings
    ]
    watcher = Watcher(machine, kept=compared_with_constants(machine))
    histories = []
    for trace in traces:
        steps = (InstantEvents(update.at_ns, update.channels) for update in trace.updates)
        histories.append(watcher.watch(steps, trace.end_ns, from_zero=False))
    coverage = watcher.coverage()
    missing = [goal for goal in coverage.goals if goal not in coverage.reached]
    margins = tuple(_margins(machine, traces, histories, on_progress))
    findings = (*compiled.warnings, *collector.sorted())
    return Exercised(
        coverage=coverage,
        reasons=unreachable(machine, missing),
        margins=margins,
        findings=findings,
        sources=compiled.sources,
        length_ns=sum(trace.end_ns - trace.updates[0].at_ns for trace in traces if trace.updates),
    )


def coverage_report(
    exercised: Exercised, rules: Path, recordings: Sequence[Path], *, version: str
) -> str:
    """The report of `cover_recordings`, for a safety file. Raises `OSError`."""
    files = [each for path in recordings for each in hashed_files(path, rules)]
    seconds = f"{exercised.length_ns / 1e9:.6g} s"
    count = len(recordings)
    return evidence_text(
        EvidenceKind.COVERAGE,
        tools={"rossmarie": version},
        sources=(*hashed_sources(exercised.sources, rules), *files),
        bound=f"{count} recording{'' if count == 1 else 's'}, {seconds}",
        results=tuple(coverage_results(exercised.coverage, exercised.reasons)),
        margins=tuple(spares(exercised.coverage.machine, exercised.margins)),
    )


def trace_of(
    machine: Machine,
    path: Path,
    message_folders: Sequence[Path],
    topic_map: Mapping[str, str],
    collector: Collector,
) -> Trace:
    """The updates that a monitor would receive from a recording."""
    with open_recording(path, message_folders) as recording:
        collector.extend(recording.findings)
        batches = recording.batches(machine, collector, topic_map)
        updates = tuple(updates_in(machine, begun_together(machine, batches)))
        last_ns = updates[-1].at_ns if updates else recording.end_ns
        return Trace(updates, max(recording.end_ns, last_ns))


def _margins(
    machine: Machine,
    traces: Sequence[Trace],
    histories: Sequence[History],
    on_progress: Progress,
) -> Iterator[ThresholdMargin]:
    found = list(thresholds(machine))
    for index, threshold in enumerate(found):
        seen = [value for history in histories for value in seen_by(machine, threshold, history)]
        yield margin(machine, threshold, seen, _replay(machine, threshold, traces, histories))
        on_progress((index + 1) / len(found))


def _replay(
    machine: Machine,
    threshold: MovableThreshold,
    traces: Sequence[Trace],
    histories: Sequence[History],
) -> Replay:
    """A function that runs the part of a machine that depends on a threshold; the whole machine if
    that part cannot be separated.
    """
    cone = cone_of(machine, threshold.propositions)
    if cone is None:
        return lambda candidate: replayed(candidate, traces)
    return lambda candidate: tuple(
        tuple(reported_by(cone, candidate, history)) for history in histories
    )


def replayed(machine: Machine, traces: Sequence[Trace]) -> Verdicts:
    """The verdicts of all rules of a machine on traces."""
    source = python.source(machine)
    found = []
    for trace in traces:
        monitor = PythonMonitor(machine, source)
        events = [
            event
            for update in trace.updates
            for event in monitor.update(update.at_ns, update.channels)
        ]
        events += monitor.advance(trace.end_ns)
        found.append(
            tuple(
                (event.rule, int(event.change), event.at_ns)
                for event in events
                if isinstance(event, Verdict)
            )
        )
    return tuple(found)
