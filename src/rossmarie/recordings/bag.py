"""Recordings of messages: .bag, .db3, .mcap and bag directories.

Messages are decoded only if a rule reads their topic. If a file is damaged in the middle, reading
continues with the messages that can be salvaged after the damage.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from rosbags.typesys.store import Typestore

from dslkit.diagnostics import Collector, Diagnostic, Remark
from rossmarie.ir import EARLIEST_NS, LATEST_NS, Array, Batch, Machine, Slot
from rossmarie.ir.beams import is_of_scan
from rossmarie.recordings.batches import Assembly
from rossmarie.recordings.clouds import is_of_points
from rossmarie.recordings.decoding import Decoder
from rossmarie.recordings.definitions import UndefinedTypeError, own_definitions, typestore_for
from rossmarie.recordings.elements import never_found
from rossmarie.recordings.errors import (
    DefinitionMissing,
    FieldNotRecorded,
    MessagesPassedOver,
    RecordingDamaged,
    RecordingError,
    at_file,
)
from rossmarie.recordings.extraction import WantedParts
from rossmarie.recordings.frames import frames_in
from rossmarie.recordings.limits import LimitError
from rossmarie.recordings.matching import (
    Match,
    Unreadable,
    field_text,
    input_span,
    kind_text,
    match_topics,
)
from rossmarie.recordings.model import FramesFound, Observe, RecordedTopic, Survey
from rossmarie.recordings.storage import Storage
from rossmarie.recordings.stored import READER_FAILURES, Packed, RecordedConnection
from rossmarie.recordings.survey import survey_of
from rossmarie.recordings.transforms import TransformDecoder, holds_transforms

_NO_CLOCK = "their stamps are outside the range of any clock"


@dataclass(frozen=True)
class _Reading:
    """The decoding of the messages of one topic, and the channels that read them.

    `transforms` decodes the messages for the channels of transforms, if the topic contains any.
    `unfit` counts the skipped messages, by reason.
    """

    decoder: Decoder | None
    transforms: TransformDecoder | None
    channels: Sequence[int]
    unreadable: Unreadable
    unfit: Counter[str]


class BagRecording:
    """A recording of messages. If its storage fails, `salvage` opens the readable rest and
    describes the loss.
    """

    def __init__(
        self,
        path: Path,
        storage: Storage,
        span: tuple[int, int],
        salvage: Callable[[], tuple[Storage, Sequence[str]]],
        message_folders: Sequence[Path] = (),
        findings: tuple[Diagnostic, ...] = (),
    ) -> None:
        self.path = path
        self.findings = findings
        self.start_ns, self.end_ns = span
        self._storages = [storage]
        self._salvage = salvage
        self._message_folders = message_folders
        self._connections = _by_topic(storage.connections)
        self.topics: Mapping[str, RecordedTopic] = {
            name: RecordedTopic(name, found[0].message_type, sum(part.count for part in found))
            for name, found in sorted(self._connections.items())
        }

    def batches(
        self, machine: Machine, collector: Collector, topic_map: Mapping[str, str]
    ) -> Iterator[Batch]:
        """See `Recording.batches`."""
        collector.extend(self.findings)
        matches = match_topics(self.topics, machine, topic_map, self.path, collector)
        readings: dict[str, _Reading] = {}
        for topic in {match.topic: None for match in matches}:
            sharing = [match for match in matches if match.topic == topic]
            reading = self._reading(topic, sharing, machine, collector)
            if reading is not None:
                readings[topic] = reading
        return self._read(machine, readings, collector)

    def frames(self) -> FramesFound:
        """See `Recording.frames`."""
        return frames_in(
            self._connections,
            lambda connection: typestore_for(connection, self._message_folders),
            lambda topics: self._stored([*topics], Collector()),
        )

    def survey(self, observers: Mapping[str, Observe], seconds: float) -> Survey:
        """See `Recording.survey`."""
        return survey_of(
            self._connections,
            lambda connection: typestore_for(connection, self._message_folders),
            lambda topics: self._stored([*topics], Collector()),
            observers,
            seconds,
        )

    def definitions(self) -> Mapping[str, str]:
        """See `Recording.definitions`."""
        return own_definitions(found[0] for found in self._connections.values())

    def close(self) -> None:
        """Release the file."""
        for storage in self._storages:
            storage.close()

    def __enter__(self) -> BagRecording:
        """Return the recording itself."""
        return self

    def __exit__(self, *reason: object) -> None:
        """Release the file."""
        self.close()

    def _reading(
        self, topic: str, matches: Sequence[Match], machine: Machine, collector: Collector
    ) -> _Reading | None:
        connection = self._connections[topic][0]
        try:
            store = typestore_for(connection, self._message_folders)
        except UndefinedTypeError as error:
            name = connection.message_type
            missing = DefinitionMissing(type_name=name, topic=topic, reason=str(error))
            for match in matches:
                for reader in match.inputs:
                    collector.add(missing.at(input_span(machine, reader)))
            return None
        edges = [each for each in matches if machine.channels[each.channel].edge is not None]
        others = [each for each in matches if each not in edges]
        decoder = _decoder(connection, store, others, machine)
        for field in () if decoder is None else decoder.missing:
            _report_missing(field, connection, machine, collector)
        transforms = None
        if edges and holds_transforms(store, connection.message_type):
            transforms = TransformDecoder(connection, store, edges, machine)
        elif edges:
            for slot in (slot for match in edges for slot in match.slots.values()):
                _report_missing(slot, connection, machine, collector)
        spans = [input_span(machine, reader) for match in matches for reader in match.inputs]
        total = self.topics[topic].count
        unreadable = Unreadable(f"messages on `{topic}`", total, self.start_ns, spans)
        channels = [match.channel for match in others]
        return _Reading(decoder, transforms, channels, unreadable, Counter())

    def _read(
        self, machine: Machine, readings: Mapping[str, _Reading], collector: Collector
    ) -> Iterator[Batch]:
        for stored in self._stored(readings, collector):
            messages = stored.only(self._fit(stored, readings))
            assembly = Assembly(machine, messages.times_ns)
            for topic, reading in readings.items():
                rows = np.flatnonzero(_is_on(topic, messages))
                _take(reading, messages, rows, assembly)
            yield assembly.batch()
        for topic, reading in readings.items():
            reading.unreadable.report(collector)
            self._report_unfit(topic, reading, collector)
            for search in () if reading.decoder is None else reading.decoder.never_found:
                collector.add(never_found(topic, search, machine))
            collector.extend(
                () if reading.transforms is None else reading.transforms.never_found(topic)
            )

    def _fit(self, stored: Packed, readings: Mapping[str, _Reading]) -> NDArray[np.bool_]:
        """A mask of the messages that fit. Skipped messages are counted."""
        is_odd_type = np.array([self._odd_type(each) is not None for each in stored.connections])
        is_early, is_late = stored.times_ns <= EARLIEST_NS, stored.times_ns >= LATEST_NS
        is_unfit = is_odd_type[stored.senders] | is_early | is_late
        for sender in stored.senders[is_unfit].tolist():
            connection = stored.connections[sender]
            reason = self._odd_type(connection) or _NO_CLOCK
            readings[connection.topic].unfit[reason] += 1
        return ~is_unfit

    def _odd_type(self, connection: RecordedConnection) -> str | None:
        """The reason why messages of a connection are skipped; None if they are read."""
        expected = self._connections[connection.topic][0].message_type
        found = connection.message_type
        if found == expected:
            return None
        return f"their type is {found}, but the rules read messages of the type {expected}"

    def _report_unfit(self, topic: str, reading: _Reading, collector: Collector) -> None:
        total = self.topics[topic].count
        for reason, count in sorted(reading.unfit.items()):
            finding = MessagesPassedOver(topic=topic, count=count, total=total, reason=reason)
            for span in reading.unreadable.spans:
                collector.add(finding.at(span))

    def _stored(self, topics: Collection[str], collector: Collector) -> Iterator[Packed]:
        """The messages on some topics. After damage, the messages after the damage follow."""
        kept = 0
        last = _Last()
        try:
            for batch in self._storages[0].batches(topics):
                last.note(batch)
                kept += len(batch)
                yield batch
            return
        except READER_FAILURES as error:
            reason = f"reading stopped ({error})"
        try:
            salvaged, losses = self._salvage()
            self._storages.append(salvaged)
            reason = losses[0] if losses else reason  # the loss names its place
            for batch in salvaged.batches(topics):
                remaining = batch.only(last.is_before(batch))
                kept += len(remaining)
                yield remaining
        except LimitError as error:
            reason = f"reading stopped ({error})"
        except RecordingError:
            pass  # nothing is left
        collector.add(at_file(RecordingDamaged(reason=reason, kept=kept), self.path))


class _Last:
    """The last instant at which messages were read, and the number of messages of each topic at
    this instant.
    """

    def __init__(self) -> None:
        self._at_ns = EARLIEST_NS
        self._counts: Counter[str] = Counter()

    def note(self, batch: Packed) -> None:
        """Note the next messages."""
        last_ns = int(batch.times_ns[-1])
        others = np.flatnonzero(batch.times_ns != last_ns)
        if len(others) or last_ns != self._at_ns:
            self._at_ns = last_ns
            self._counts.clear()
        first = int(others[-1]) + 1 if len(others) else 0
        senders = batch.senders[first:].tolist()
        self._counts.update(batch.connections[sender].topic for sender in senders)

    def is_before(self, batch: Packed) -> NDArray[np.bool_]:
        """A mask of the messages that have not been read yet. Messages of one topic at one instant
        always come in the same order, however the file is read.
        """
        is_after = batch.times_ns >= self._at_ns
        for row in np.flatnonzero(batch.times_ns == self._at_ns).tolist():
            topic = batch.connections[batch.senders[row]].topic
            if self._counts[topic] > 0:
                self._counts[topic] -= 1
                is_after[row] = False
        return is_after


def _decoder(
    connection: RecordedConnection, store: Typestore, matches: Sequence[Match], machine: Machine
) -> Decoder | None:
    slots = {index: slot for match in matches for index, slot in match.slots.items()}
    arrays = {index: array for match in matches for index, array in match.arrays.items()}
    if not matches:
        return None
    return Decoder(connection, store, WantedParts(slots, arrays, machine.lists), machine.texts)


def _take(reading: _Reading, messages: Packed, rows: NDArray[np.intp], assembly: Assembly) -> None:
    """Add the messages of one topic, at these rows, to a batch."""
    of_topic = messages.only(rows)
    if reading.decoder is not None:
        decoded = reading.decoder.decode(of_topic)
        for row, reason in decoded.failures:
            reading.unreadable.note(int(of_topic.times_ns[row]), reason)
        assembly.add(reading.channels, rows, decoded.slots, decoded.arrays)
    if reading.transforms is None:
        return
    for row, found in reading.transforms.decode(of_topic):
        if isinstance(found, str):
            reading.unreadable.note(int(of_topic.times_ns[row]), found)
            continue
        for channel, values in found.items():
            assembly.put(int(rows[row]), channel, values)


def _is_on(topic: str, messages: Packed) -> NDArray[np.bool_]:
    """A mask of the messages on a topic."""
    is_there = np.array([each.topic == topic for each in messages.connections], np.bool_)
    return is_there[messages.senders]


def _by_topic(connections: Sequence[RecordedConnection]) -> dict[str, list[RecordedConnection]]:
    """The connections of each topic; connections with a definition come first."""
    found: dict[str, list[RecordedConnection]] = {}
    for connection in sorted(connections, key=lambda connection: not connection.definition.data):
        found.setdefault(connection.topic, []).append(connection)
    return found


def _report_missing(
    missing: Slot | Array, connection: RecordedConnection, machine: Machine, collector: Collector
) -> None:
    finding = FieldNotRecorded(
        topic=connection.topic,
        field=field_text(missing.path),
        kind=kind_text(missing),
        reason=f"this is the definition of the recorded {connection.message_type}",
    )
    other_cloud = FieldNotRecorded.OtherCloud(message_type=connection.message_type)
    other_scan = FieldNotRecorded.OtherScan(message_type=connection.message_type)
    help: Remark | None = None
    if isinstance(missing, Array) and is_of_points(missing):
        help = other_cloud
    elif isinstance(missing, Array) and is_of_scan(missing):
        help = other_scan
    collector.add(finding.at(input_span(machine, missing.input), help=help))
