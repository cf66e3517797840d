"""A rules file run over a recording."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

from dslkit.diagnostics import Collector, Diagnostic
from rossmarie.driver.monitor import Started, start_engine
from rossmarie.driver.pipeline import compile_file
from rossmarie.driver.sampler import Sampler
from rossmarie.ir import Event
from rossmarie.recordings import Recording, Update, open_recording
from rossmarie.report import Replay, rehearse

Progress = Callable[[float], None]
"""Called now and then with the part of the recording that is done, from 0 to 1."""

_STEPS = 200


def replay_file(
    rules: Path,
    recording_path: Path,
    *,
    topic_map: Mapping[str, str],
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
    on_progress: Progress = lambda _: None,
) -> tuple[Replay, tuple[Diagnostic, ...]]:
    """The verdicts of a rules file on a recording, and the findings on both.

    `topic_map` leads from topics of the rules to recorded ones. Raises `RulesError` for errors in
    the rules and `RecordingError` if nothing can be read.
    """
    compiled = compile_file(rules, systems=systems, message_folders=message_folders)
    machine = compiled.machine
    collector = Collector()
    with open_recording(recording_path, compiled.message_folders) as recording:
        collector.extend(recording.findings)
        updates = recording.updates(machine, collector, topic_map)
        started = start_engine(machine)
        sampler = Sampler(machine)
        events: list[Event] = []
        for update in _told(updates, recording, on_progress):
            events += started.engine.update(update.at_ns, update.channels)
            sampler.feed(update)
        # Rows that no rule reads may come before the first sample and after the last one.
        start_ns = min((recording.start_ns, *sampler.instants[:1]))
        end_ns = max((recording.end_ns, *sampler.instants[1:]))
        events += started.engine.advance(end_ns)
        replay = Replay(
            machine=machine,
            rules_file=str(rules),
            recording=str(recording_path),
            monitor=started.kind,
            start_ns=start_ns,
            end_ns=end_ns,
            events=tuple(events),
            plots=sampler.plots(start_ns),
            notes=_notes(started, collector.sorted()),
            rehearsed=rehearse(machine, events, end_ns),
        )
    return replay, (*compiled.warnings, *collector.sorted())


def _notes(started: Started, found: Sequence[Diagnostic]) -> tuple[str, ...]:
    reasons = [started.reason] if started.reason else []
    return (*reasons, *(f"{finding.title}: {finding.primary.text}" for finding in found))


def _told(
    updates: Iterator[Update], recording: Recording, on_progress: Progress
) -> Iterator[Update]:
    """The same updates, with word of how far they have come."""
    length = max(recording.end_ns - recording.start_ns, 1)
    told = 0
    for update in updates:
        yield update
        step = (update.at_ns - recording.start_ns) * _STEPS // length
        if step > told:
            told = step
            on_progress(min(step / _STEPS, 1.0))
    on_progress(1.0)
