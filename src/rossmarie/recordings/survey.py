"""A survey of a recording: the rhythm of its topics, and samples of their messages."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from rosbags.typesys.store import Typestore

from rossmarie.ir import EARLIEST_NS, LATEST_NS
from rossmarie.recordings.decoding import DECODE_FAILURES, decoding_of
from rossmarie.recordings.definitions import UndefinedTypeError
from rossmarie.recordings.frames import FrameSearch, Read
from rossmarie.recordings.model import Observe, Rhythm, Survey
from rossmarie.recordings.stored import Packed, RecordedConnection

_MOST_SAMPLES = 2000
"""The most messages of a topic that are decoded."""

_FAILURES: tuple[type[Exception], ...] = (*DECODE_FAILURES, AttributeError)


@dataclass
class _Listening:
    """The arrivals on one topic so far; every `stride`th message is decoded."""

    read: Read
    observe: Observe
    stride: int
    count: int = 0
    stamps: list[NDArray[np.int64]] = field(default_factory=list)

    def note(self, batch: Packed, rows: NDArray[np.intp]) -> None:
        """Note the next messages."""
        self.stamps.append(batch.times_ns[rows])
        for number, row in enumerate(rows.tolist(), self.count):
            if number % self.stride:
                continue
            try:
                self.observe(self.read(batch.message(row)))
            except _FAILURES:
                continue
        self.count += len(rows)

    def rhythm(self) -> Rhythm:
        """The rhythm so far."""
        stamps = np.concatenate(self.stamps) if self.stamps else np.empty(0, np.int64)
        stamps = np.sort(stamps[(stamps > EARLIEST_NS) & (stamps < LATEST_NS)])
        gaps = np.diff(stamps)
        if not len(gaps):
            return Rhythm(len(stamps), 0, 0, 0.0)
        median = int(np.median(gaps))
        outliers = float(np.mean(gaps > Rhythm.OUTLIER * median))
        return Rhythm(len(stamps), median, int(gaps.max()), outliers)


def survey_of(
    connections: Mapping[str, Sequence[RecordedConnection]],
    store_of: Callable[[RecordedConnection], Typestore],
    batches: Callable[[Iterable[str]], Iterable[Packed]],
    observers: Mapping[str, Observe],
    seconds: float,
) -> Survey:
    """See `Recording.survey`."""
    listening = {}
    for topic, observe in observers.items():
        first = connections[topic][0]
        try:
            read = decoding_of(first, store_of(first))
        except UndefinedTypeError:
            continue
        total = sum(part.count for part in connections[topic])
        listening[topic] = _Listening(read, observe, max(1, total // _MOST_SAMPLES))
    search = FrameSearch(connections, store_of, headers_of=listening.keys())
    ends_at, end_ns = time.monotonic() + seconds, 0
    for batch in batches({*listening, *search.topics}):
        _note(batch, listening)
        search.note(batch)
        end_ns = int(batch.times_ns[-1])
        if time.monotonic() > ends_at:
            return Survey(_rhythms(listening), search.found(), end_ns, is_whole=False)
    return Survey(_rhythms(listening), search.found(), end_ns)


def _note(batch: Packed, listening: Mapping[str, _Listening]) -> None:
    senders = np.array([each.topic for each in batch.connections])
    for topic, each in listening.items():
        rows = np.flatnonzero((senders == topic)[batch.senders])
        if len(rows):
            each.note(batch, rows)


def _rhythms(listening: Mapping[str, _Listening]) -> dict[str, Rhythm]:
    return {topic: each.rhythm() for topic, each in listening.items()}
