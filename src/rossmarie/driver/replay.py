"""A rules file run over a recording."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

from dslkit.diagnostics import Collector, Diagnostic
from rossmarie.driver.pipeline import check_file, compile_checked
from rossmarie.driver.recorded import recorded_plots
from rossmarie.driver.sampler import Sampler
from rossmarie.driver.taking import taking
from rossmarie.engines import MonitorEngine, Started, start_monitor
from rossmarie.ir import Batch, Category, Event
from rossmarie.recordings.batches import begun_together
from rossmarie.recordings.model import Recording
from rossmarie.recordings.opening import open_recording
from rossmarie.report.model import Plot, Replay
from rossmarie.report.rehearsal import rehearse

Progress = Callable[[float], None]
"""Called from time to time with the completed share of the recording, from 0 to 1."""


def replay_file(
    rules: Path,
    recording_path: Path,
    *,
    topic_map: Mapping[str, str],
    systems: Sequence[Path] = (),
    message_folders: Sequence[Path] = (),
    only: Sequence[Category] = (),
    with_recorded: bool = False,
    on_progress: Progress = lambda _: None,
) -> tuple[Replay, tuple[Diagnostic, ...]]:
    """The verdicts of a rules file on a recording, and the findings on both.

    `topic_map` maps topics of the rules to recorded topics. `with_recorded` also samples the
    numbers that no rule compares, in a second pass over the recording. Raises `RulesError` for
    errors in the rules (`only` of these categories) and `RecordingError` if nothing can be read.
    """
    checked = check_file(rules, systems=systems, message_folders=message_folders, only=only)
    compiled = compile_checked(checked, message_folders)
    machine = compiled.machine
    inputs = () if checked.program is None else tuple(checked.program.symbols.inputs.values())
    collector = Collector()
    with open_recording(recording_path, compiled.message_folders) as recording:
        collector.extend(recording.findings)
        batches = begun_together(machine, recording.batches(machine, collector, topic_map))
        sampler = Sampler(machine)
        started = start_monitor(machine)
        take = taking(machine, started.engine, sampler.signals)
        events: list[Event] = []
        for batch in _reported(batches, recording, on_progress):
            taken = take(batch)
            events += taken.events
            sampler.take(taken.times_ns, taken.values)
        # Rows that no rule reads may come before the first sample and after the last sample.
        start_ns = min((recording.start_ns, *sampler.instants[:1]))
        end_ns = max((recording.end_ns, *sampler.instants[1:]))
        events += started.engine.advance(end_ns)
        recorded: tuple[Plot, ...] = ()
        if with_recorded:
            recorded = recorded_plots(recording, inputs, topic_map, start_ns)
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
            recorded=recorded,
        )
    return replay, (*compiled.warnings, *collector.sorted())


def _notes(started: Started[MonitorEngine], found: Sequence[Diagnostic]) -> tuple[str, ...]:
    reasons = [started.reason] if started.reason else []
    return (*reasons, *(f"{finding.title}: {finding.primary.text}" for finding in found))


def _reported(
    batches: Iterator[Batch], recording: Recording, on_progress: Progress
) -> Iterator[Batch]:
    """The batches, unchanged; progress is reported meanwhile."""
    length = max(recording.end_ns - recording.start_ns, 1)
    reported = 0.0
    for batch in batches:
        yield batch
        done = (int(batch.times_ns.max(initial=recording.start_ns)) - recording.start_ns) / length
        if done > reported:
            reported = min(done, 1.0)
            on_progress(reported)
    on_progress(1.0)
