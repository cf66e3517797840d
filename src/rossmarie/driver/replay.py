"""A rules file run over a recording."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from dslkit.diagnostics import Collector, Diagnostic
from rossmarie.driver.monitor import Started, start_engine
from rossmarie.driver.pipeline import compile_file
from rossmarie.interpreter import Interpreter
from rossmarie.ir import Event, Machine
from rossmarie.recordings import Recording, Update, open_recording
from rossmarie.report import Plot, Replay, axis_seconds, plan_plots, rehearse

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
        sampler = _Sampler(machine)
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


class _Sampler:
    """Samples the plotted signals: a machine without rules, run beside the monitor."""

    def __init__(self, machine: Machine) -> None:
        self._plans = plan_plots(machine)
        without_rules = dataclasses.replace(machine, rules=())  # signals may count truths
        self._machine = Interpreter(without_rules)
        self._times_ns: list[int] = []
        self._rows: list[tuple[float, ...]] = []

    @property
    def instants(self) -> tuple[int, ...]:
        """The instants of the first and the last sample; nothing if there is none."""
        return (self._times_ns[0], self._times_ns[-1]) if self._times_ns else ()

    def feed(self, update: Update) -> None:
        """Take a sample after a message, and before it wherever an input expires."""
        while (wake_ns := self._machine.next_wake()) is not None and wake_ns < update.at_ns:
            self._machine.advance(wake_ns)
            self._keep(wake_ns)
        self._machine.update(update.at_ns, update.channels)
        self._keep(update.at_ns)

    def _keep(self, at_ns: int) -> None:
        values = self._machine.signals
        self._times_ns.append(at_ns)
        self._rows.append(tuple(values[plan.signal] for plan in self._plans))

    def plots(self, start_ns: int) -> tuple[Plot, ...]:
        """What has been sampled."""
        times_s = axis_seconds(np.array(self._times_ns, dtype=np.int64), start_ns)
        values = np.array(self._rows, dtype=np.float64).reshape(len(times_s), len(self._plans))
        return tuple(
            plan.plot(times_s, values[:, column]) for column, plan in enumerate(self._plans)
        )
