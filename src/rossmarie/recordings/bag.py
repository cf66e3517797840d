"""Recordings of messages: .bag, .db3, .mcap and bag directories.

Messages are decoded only if a rule reads their topic. Where a file turns out to be damaged in the
middle, what can be salvaged after the damage is read on.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from rosbags.serde import SerdeError

from dslkit.diagnostics import Collector, Diagnostic
from rossmarie.ir import EARLIEST_NS, LATEST_NS, ChannelValues, Machine
from rossmarie.recordings.definitions import UndefinedTypeError, full_type, typestore_for
from rossmarie.recordings.errors import (
    DefinitionMissing,
    FieldNotRecorded,
    MessagesPassedOver,
    RecordingDamaged,
    RecordingError,
    at_file,
)
from rossmarie.recordings.extraction import Extractor, Message, Wanted, compile_extractor
from rossmarie.recordings.limits import LimitError
from rossmarie.recordings.matching import (
    Match,
    Unreadable,
    field_text,
    input_span,
    kind_text,
    match_topics,
)
from rossmarie.recordings.message_sizes import Sizes
from rossmarie.recordings.model import Topic, Update
from rossmarie.recordings.storage import READER_FAILURES, Connection, Storage, Stored

DECODE_FAILURES: tuple[type[Exception], ...] = (
    SerdeError,
    ArithmeticError,
    AssertionError,
    LookupError,
    MemoryError,
    TypeError,
    ValueError,
)
"""What decoding raises on content that does not match its definition."""

_UNKNOWN = ChannelValues({}, {})


@dataclass(frozen=True)
class _Reading:
    """How the messages of one topic are decoded, and who reads them.

    `unfit` counts the messages that are passed over, by the reason.
    """

    decode: Callable[[bytes], Message]
    extractors: Mapping[int, Extractor]
    unreadable: Unreadable
    unfit: Counter[str]


class BagRecording:
    """A recording of messages; `salvage` opens what is left of it if its storage fails, and says
    what is missing.
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
        self.topics: Mapping[str, Topic] = {
            name: Topic(name, found[0].message_type, sum(part.count for part in found))
            for name, found in sorted(self._connections.items())
        }

    def updates(
        self, machine: Machine, collector: Collector, topic_map: Mapping[str, str]
    ) -> Iterator[Update]:
        """See `Recording.updates`."""
        collector.extend(self.findings)
        matches = match_topics(self.topics, machine, topic_map, self.path, collector)
        readings: dict[str, _Reading] = {}
        for topic in {match.topic: None for match in matches}:
            sharing = [match for match in matches if match.topic == topic]
            reading = self._reading(topic, sharing, machine, collector)
            if reading is not None:
                readings[topic] = reading
        return self._read(readings, collector)

    def messages(
        self, topics: Collection[str], collector: Collector
    ) -> Iterator[tuple[str, int, bytes]]:
        """Topic, stamp and encoded content of the messages on some topics, in order of time.

        Damage that shows up on the way is reported to `collector`.
        """
        for stored in self._stored(topics, collector):
            if self._misfit(stored) is None:
                yield stored.connection.topic, stored.at_ns, stored.content

    def close(self) -> None:
        """Release the file."""
        for storage in self._storages:
            storage.close()

    def __enter__(self) -> BagRecording:
        """The recording itself."""
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
        name = full_type(connection.message_type)
        extractors = {
            match.channel: compile_extractor(
                store, connection.message_type, Wanted(match.slots, match.arrays), machine.texts
            )
            for match in matches
        }
        for extractor in extractors.values():
            _report_missing(extractor, connection, machine, collector)
        decode = store.deserialize_ros1 if connection.encoding == "ros1" else store.deserialize_cdr
        spans = [input_span(machine, reader) for match in matches for reader in match.inputs]
        total = self.topics[topic].count
        unreadable = Unreadable(f"messages on `{topic}`", total, self.start_ns, spans)
        most = Sizes(store.fielddefs).largest_message(name)

        def read(content: bytes) -> Message:
            if most is not None and len(content) > most:
                raise LimitError(f"it is larger than {most >> 20} MiB, and its parts are small")
            return decode(content, name)

        return _Reading(read, extractors, unreadable, Counter())

    def _read(self, readings: Mapping[str, _Reading], collector: Collector) -> Iterator[Update]:
        for stored in self._stored(readings, collector):
            reading = readings[stored.connection.topic]
            unfit = self._misfit(stored)
            if unfit is not None:
                reading.unfit[unfit] += 1
                continue
            try:
                message = reading.decode(stored.content)
            except DECODE_FAILURES as error:
                reading.unreadable.note(stored.at_ns, str(error) or type(error).__name__)
                yield Update(stored.at_ns, dict.fromkeys(reading.extractors, _UNKNOWN))
                continue
            extractors = reading.extractors.items()
            values = {channel: extractor.read(message) for channel, extractor in extractors}
            yield Update(stored.at_ns, values)
        for topic, reading in readings.items():
            reading.unreadable.report(collector)
            self._report_unfit(topic, reading, collector)

    def _report_unfit(self, topic: str, reading: _Reading, collector: Collector) -> None:
        total = self.topics[topic].count
        for reason, count in sorted(reading.unfit.items()):
            finding = MessagesPassedOver(topic=topic, count=count, total=total, reason=reason)
            for span in reading.unreadable.spans:
                collector.add(finding.at(span))

    def _stored(self, topics: Collection[str], collector: Collector) -> Iterator[Stored]:
        """The messages on some topics; after damage, those that come after it."""
        kept = 0
        last_ns = EARLIEST_NS
        latest: Counter[str] = Counter()  # how many messages of each topic there are at `last_ns`
        try:
            for stored in self._storages[0].messages(topics):
                if stored.at_ns != last_ns:
                    last_ns = stored.at_ns
                    latest.clear()
                latest[stored.connection.topic] += 1
                kept += 1
                yield stored
            return
        except READER_FAILURES as error:
            reason = f"reading broke off ({error})"
        try:
            salvaged, losses = self._salvage()
            self._storages.append(salvaged)
            reason = losses[0] if losses else reason  # which knows the place
            for stored in _messages_after(salvaged.messages(topics), last_ns, latest):
                kept += 1
                yield stored
        except LimitError as error:
            reason = f"reading broke off ({error})"
        except RecordingError:
            pass  # there is nothing left
        collector.add(at_file(RecordingDamaged(reason=reason, kept=kept), self.path))

    def _misfit(self, stored: Stored) -> str | None:
        """Why a message is passed over; None if it is not."""
        expected = self._connections[stored.connection.topic][0].message_type
        found = stored.connection.message_type
        if found != expected:
            return f"their type is {found}; those that are read are of the type {expected}"
        if not EARLIEST_NS < stored.at_ns < LATEST_NS:
            return "their stamps are out of range: no clock runs that long"
        return None


def _messages_after(
    messages: Iterator[Stored], last_ns: int, latest: Counter[str]
) -> Iterator[Stored]:
    """Those behind the first messages at an instant, `latest` of each topic: those of one topic at
    one instant are stored in one order, however a file is read.
    """
    for stored in messages:
        topic = stored.connection.topic
        if stored.at_ns == last_ns and latest[topic] > 0:
            latest[topic] -= 1
        elif stored.at_ns >= last_ns:
            yield stored


def _by_topic(connections: Sequence[Connection]) -> dict[str, list[Connection]]:
    """The connections of each topic; those that bring a definition come first."""
    found: dict[str, list[Connection]] = {}
    for connection in sorted(connections, key=lambda connection: not connection.definition.data):
        found.setdefault(connection.topic, []).append(connection)
    return found


def _report_missing(
    extractor: Extractor, connection: Connection, machine: Machine, collector: Collector
) -> None:
    for missing in extractor.missing:
        finding = FieldNotRecorded(
            topic=connection.topic,
            field=field_text(missing.path),
            kind=kind_text(missing),
            reason=f"this is how the recorded {connection.message_type} is defined",
        )
        collector.add(finding.at(input_span(machine, missing.input)))
