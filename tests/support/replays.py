"""Replays as their users see them, and how they were done before: message by message."""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from dslkit.diagnostics import Collector, Diagnostic
from rossmarie.driver import replay as replaying
from rossmarie.driver.pipeline import check_file
from rossmarie.engines import NATIVE
from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, Machine, Taken
from rossmarie.recordings import csv_table, decoding, storage
from rossmarie.recordings.bag import BagRecording
from rossmarie.recordings.bag_columns import BagChunks
from rossmarie.recordings.errors import RecordingError
from rossmarie.recordings.model import Update
from rossmarie.recordings.stored import packed, unpacked
from rossmarie.report.jsonl import verdict_lines
from rossmarie.report.table import write_table
from rossmarie.report.timeline import render_timeline

_checked = cache(check_file)


def reported(rules: Path, recording: Path) -> list[str]:
    """All that a replay says: findings, table, verdicts and timeline. It is not said by which
    monitor: there, all replays are alike.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(replaying, "check_file", lambda path, **_: _checked(path))
        try:
            replay, found = replaying.replay_file(rules, recording, topic_map={})
        except RecordingError as error:
            return _texts([error.diagnostic])
    notes = replay.notes if replay.monitor == NATIVE else replay.notes[1:]
    replay = replace(replay, monitor=NATIVE, notes=notes)
    table = io.StringIO()
    write_table(replay, table)
    return [*_texts(found), table.getvalue(), *verdict_lines(replay), render_timeline(replay)]


def _texts(found: Sequence[Diagnostic]) -> list[str]:
    return [str(finding) for finding in found]


@contextmanager
def message_by_message() -> Iterator[None]:
    """Without columns: rosbags reads and decodes each message, the monitor takes it in a call of
    its own, and the interpreter runs beside it.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(storage, "has_chunks", lambda _: False)
        patch.setattr(BagChunks, "batches", lambda chunks, rows: packed(chunks._by_rosbags(rows)))
        patch.setattr(BagRecording, "_read", _each_update)
        patch.setattr(csv_table, "batched", lambda _, updates: updates)
        patch.setattr(replaying, "begun_together", lambda _, updates: _begun_together(updates))
        patch.setattr(replaying, "_reported", lambda updates, *_: updates)
        patch.setattr(replaying, "taking", _OneByOne)
        yield


def _each_update(
    recording: Any, _: Machine, readings: Mapping[str, Any], collector: Collector
) -> Iterator[Update]:
    for stored in recording._stored(readings, collector):
        for connection, at_ns, content in unpacked(stored.only(recording._fit(stored, readings))):
            reading = readings[connection.topic]
            values = ChannelValues()
            try:
                values = reading.decoder._read(reading.decoder._message(content))
            except decoding.DECODE_FAILURES as error:
                reading.unreadable.note(at_ns, str(error) or type(error).__name__)
            yield Update(at_ns, dict.fromkeys(reading.channels, values))
    for topic, reading in readings.items():
        reading.unreadable.report(collector)
        recording._report_unfit(topic, reading, collector)


def _begun_together(updates: Iterable[Update]) -> Iterator[Update]:
    """The messages of the first instant as one update, up to the second one on any channel."""
    begin: Update | None = None
    is_beginning = True
    for update in updates:
        if begin is None:
            begin = update
        elif (
            is_beginning
            and update.at_ns == begin.at_ns
            and not begin.channels.keys() & update.channels.keys()
        ):
            begin = Update(begin.at_ns, {**begin.channels, **update.channels})
        else:
            if is_beginning:
                yield begin
            is_beginning = False
            yield update
    if begin is not None and is_beginning:
        yield begin


class _OneByOne:
    """Takes updates."""

    def __init__(self, machine: Machine, engine: Any, shown: Sequence[int]) -> None:
        self._engine = engine
        self._beside = Interpreter(replace(machine, rules=()))
        self._shown = shown

    def __call__(self, update: Update) -> Taken:
        events = self._engine.update(update.at_ns, update.channels)
        times_ns, rows = [], []
        while (wake_ns := self._beside.next_wake()) is not None and wake_ns < update.at_ns:
            self._beside.advance(wake_ns)
            times_ns.append(wake_ns)
            rows.append([self._beside.signals[signal] for signal in self._shown])
        self._beside.update(update.at_ns, update.channels)
        times_ns.append(update.at_ns)
        rows.append([self._beside.signals[signal] for signal in self._shown])
        values = np.array(rows, np.float64).reshape(len(rows), len(self._shown))
        return Taken(events, np.array(times_ns, np.int64), values)


@contextmanager
def without_compiler() -> Iterator[None]:
    """The monitor runs in Python."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("CC", "no-such-compiler")
        yield
