"""What recordings exercise of a rules file, and how much its thresholds leave to spare."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from dslkit.diagnostics import Collector, Diagnostic
from rossmarie.driver.pipeline import compile_file
from rossmarie.driver.python_monitor import PythonMonitor
from rossmarie.ir import Machine, Verdict
from rossmarie.recordings import Update, open_recording
from rossmarie.targets import python
from rossmarie.testing.coverage import Coverage, Watcher
from rossmarie.testing.goals import Goal
from rossmarie.testing.margins import Margin, Verdicts, margin, thresholds
from rossmarie.testing.play import Step
from rossmarie.testing.unreachable import unreachable

Progress = Callable[[float], None]
"""Called now and then with the part of the work that is done, from 0 to 1."""


@dataclass(frozen=True)
class Exercised:
    """What recordings cover, why some goals cannot be reached, how far each threshold can go, and
    the findings on rules and recordings.
    """

    coverage: Coverage
    reasons: Mapping[Goal, str]
    margins: tuple[Margin, ...]
    findings: tuple[Diagnostic, ...]


@dataclass(frozen=True)
class _Trace:
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
    """Look at recordings together. Raises `RulesError`, and `RecordingError` if nothing can be read
    of one of them.
    """
    compiled = compile_file(rules, systems=systems, message_folders=message_folders)
    machine = compiled.machine
    collector = Collector()
    traces = [
        _trace(machine, path, compiled.message_folders, topic_map, collector) for path in recordings
    ]
    watcher = Watcher(machine, seen={})
    for trace in traces:
        steps = (Step(update.at_ns, update.channels) for update in trace.updates)
        watcher.watch(steps, trace.end_ns, from_zero=False)
    coverage = watcher.coverage()
    missing = [goal for goal in coverage.goals if goal not in coverage.reached]
    margins = tuple(_margins(machine, traces, watcher, on_progress))
    findings = (*compiled.warnings, *collector.sorted())
    return Exercised(coverage, unreachable(machine, missing), margins, findings)


def _trace(
    machine: Machine,
    path: Path,
    message_folders: Sequence[Path],
    topic_map: Mapping[str, str],
    collector: Collector,
) -> _Trace:
    with open_recording(path, message_folders) as recording:
        collector.extend(recording.findings)
        updates = tuple(recording.updates(machine, collector, topic_map))
        last_ns = updates[-1].at_ns if updates else recording.end_ns
        return _Trace(updates, max(recording.end_ns, last_ns))


def _margins(
    machine: Machine, traces: Sequence[_Trace], watcher: Watcher, on_progress: Progress
) -> list[Margin]:
    def replay(candidate: Machine) -> Verdicts:
        return _verdicts(candidate, traces)

    found = list(thresholds(machine))
    usual = replay(machine)
    seen = watcher.seen or {}
    margins = []
    for index, threshold in enumerate(found):
        values = [value for truth in threshold.truths for value in seen.get(truth, ())]
        margins.append(margin(machine, threshold, values, replay, usual))
        on_progress((index + 1) / len(found))
    return margins


def _verdicts(machine: Machine, traces: Sequence[_Trace]) -> Verdicts:
    """How often, and in which order, each rule changes in each trace."""
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
        changes = [
            (event.rule, int(event.change)) for event in events if isinstance(event, Verdict)
        ]
        found.append(tuple(sorted(changes, key=lambda change: change[0])))
    return tuple(found)
