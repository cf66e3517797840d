"""The recorded topic that each channel of a machine reads, and the problems with it."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from dslkit import diagnostics
from dslkit.diagnostics import Collector, Diagnostic, Remark, Template, remarked
from dslkit.source import SourceFile, Span
from rossmarie.ir import (
    TRANSFORMS,
    Array,
    Channel,
    FieldKind,
    Machine,
    Slot,
    Step,
    is_setting,
    path_text,
)
from rossmarie.recordings.errors import (
    MessagesUnreadable,
    NothingToReplay,
    RecordingError,
    TopicLeftOut,
    TopicMapUnused,
    TopicNeverSent,
    TopicNotRecorded,
    TopicOfAnotherType,
    at_file,
)
from rossmarie.recordings.model import RecordedTopic

_OF_TRANSFORMS = (TRANSFORMS, "tf/tfMessage")
"""The types of messages with transforms: the usual type, and the type in old recordings."""


@dataclass(frozen=True)
class Match:
    """A channel, the recorded topic that it reads, and the fields that it reads from the
    messages.
    """

    channel: int
    topic: str
    inputs: tuple[int, ...]
    slots: Mapping[int, Slot]
    arrays: Mapping[int, Array]

    def fields_of(self, reader: int) -> list[Slot | Array]:
        """The fields that one of the inputs reads."""
        fields: list[Slot | Array] = [*self.slots.values(), *self.arrays.values()]
        return [field for field in fields if field.input == reader]


@dataclass
class Unreadable:
    """Counts the unreadable messages of one topic, and stores the first case.

    `what` are the counted items, such as "messages on `/odom`"; `help` replaces the usual help.
    """

    what: str
    total: int
    start_ns: int
    spans: Sequence[Span]
    help: Remark | None = None
    count: int = 0
    first: tuple[int, str] | None = None

    def note(self, at_ns: int, reason: str) -> None:
        """Count one more message."""
        self.count += 1
        self.first = self.first or (at_ns, reason)

    def report(self, collector: Collector) -> None:
        """Report the count once, at every input concerned."""
        if self.first is None:
            return
        at_ns, reason = self.first
        finding = MessagesUnreadable(
            what=self.what,
            count=self.count,
            total=self.total,
            seconds=(at_ns - self.start_ns) / 1e9,
            reason=reason,
        )
        for span in self.spans:
            collector.add(finding.at(span, help=self.help))


def channel_match(machine: Machine, channel: int, topic: str) -> Match:
    """The match of a channel with the recorded topic that it reads."""
    inputs = tuple(i for i, found in enumerate(machine.inputs) if found.channel == channel)
    slots = {i: slot for i, slot in enumerate(machine.slots) if slot.input in inputs}
    arrays = {i: array for i, array in enumerate(machine.arrays) if array.input in inputs}
    return Match(channel, topic, inputs, slots, arrays)


def match_topics(
    topics: Mapping[str, RecordedTopic],
    machine: Machine,
    topic_map: Mapping[str, str],
    path: Path,
    collector: Collector,
) -> list[Match]:
    """The channels whose topics are recorded with the expected type and at least one message.

    Other channels are reported, except for parameters of the node: without a value, the default
    counts. Raises `RecordingError` if no channel is left.
    """
    check_topic_map(machine, topic_map)
    matches = []
    for number, channel in enumerate(machine.channels):
        match = channel_match(machine, number, topic_map.get(channel.source, channel.source))
        finding, help = _trouble(topics, channel, match.topic)
        if finding is None:
            matches.append(match)
        elif not is_setting(channel):
            for reader in match.inputs:
                collector.add(finding.at(input_span(machine, reader), help=help))
    if not matches and machine.channels:
        raise nothing_to_replay(topics, machine, path, collector)
    return matches


def nothing_to_replay(
    topics: Mapping[str, RecordedTopic], machine: Machine, path: Path, collector: Collector
) -> RecordingError:
    """The error that no channel of a machine can be read, with all findings on the channels."""
    topics_read = {each.source for each in machine.channels if not is_setting(each)}
    expected = listed(topics_read)
    finding = at_file(NothingToReplay(expected=expected, recorded=listed(topics)), path)
    return with_reasons(finding, collector)


def with_reasons(
    finding: Diagnostic, collector: Collector, help: Remark | None = None
) -> RecordingError:
    """The error for a finding that ends the reading. All earlier findings are its notes."""
    reported = {TopicLeftOut(title=each.title, help=each.help or "") for each in collector.sorted()}
    return RecordingError(remarked(finding, *sorted(reported, key=str), help=help))


def check_topic_map(machine: Machine, topic_map: Mapping[str, str]) -> None:
    """Raise `RecordingError` if the map contains a topic that no channel reads."""
    known = list(dict.fromkeys(channel.source for channel in machine.channels))
    for topic, recorded in topic_map.items():
        if topic not in known:
            near = difflib.get_close_matches(topic, known, n=1)
            span = Span(SourceFile("--topic-map", f"{topic}={recorded}"), 0, len(topic))
            finding = TopicMapUnused(topic=topic, known=listed(known))
            help = finding.Near(near=near[0], recorded=recorded) if near else None
            raise RecordingError(finding.at(span, help=help))


def _trouble(
    topics: Mapping[str, RecordedTopic], channel: Channel, name: str
) -> tuple[Template | None, Remark | None]:
    """The problem that prevents a channel from reading the recorded topic `name`, and a specific
    help if there is one.
    """
    types = (channel.message_type,) if channel.edge is None else _OF_TRANSFORMS
    wanted = types[0]
    topic = topics.get(name)
    if topic is None:
        finding = TopicNotRecorded(topic=name, read_as=channel.source, recorded=listed(topics))
        near = _alternative(topics, name, wanted)
        return finding, finding.Near(near=near, topic=channel.source) if near else None
    if topic.message_type not in (None, *types):
        recorded = topic.message_type or "?"
        return TopicOfAnotherType(topic=name, recorded=recorded, expected=wanted), None
    return (TopicNeverSent(topic=name), None) if topic.count == 0 else (None, None)


def _alternative(topics: Mapping[str, RecordedTopic], name: str, message_type: str) -> str | None:
    """The recorded topic that the user most likely meant: one with the right type and a similar
    name.
    """
    fitting = [
        topic.name for topic in topics.values() if topic.message_type in (None, message_type)
    ]
    near = difflib.get_close_matches(name, fitting, n=1, cutoff=0.5)
    near = near or [topic for topic in fitting if topic.endswith(name) or name.endswith(topic)]
    return near[0] if near else fitting[0] if len(fitting) == 1 else None


def input_span(machine: Machine, number: int) -> Span:
    """The place of an input's declaration."""
    return machine.inputs[number].span


def field_text(path: Iterable[Step]) -> str:
    """A path in the notation of rules: `position[0].x`."""
    return path_text(path).removeprefix(".")


def kind_text(wanted: Slot | Array) -> str:
    """The expected kind of a field, in words."""
    if isinstance(wanted, Array) and wanted.list is None:
        return "an array of numbers"
    return "a string" if wanted.kind is FieldKind.TEXT else "a number"


def lengths(counts: Iterable[int]) -> str:
    """Numbers of elements for a sentence: `1 or 2 elements`."""
    *others, last = sorted(counts)
    text = f"{', '.join(map(str, others))} or {last}" if others else str(last)
    return f"{text} element{'s' * (others != [] or last != 1)}"


def listed(names: Iterable[str], none: str = "no topic") -> str:
    """Names for a sentence, in alphabetical order; `none` if there is none."""
    return diagnostics.listed(sorted(names)) or none
