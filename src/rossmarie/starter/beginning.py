"""The texts of a system model and of first rules, written from a recording."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rossmarie.recordings.errors import RecordingError, at_file
from rossmarie.recordings.matching import listed
from rossmarie.recordings.model import Observe, RecordedTopic, Recording, Survey
from rossmarie.recordings.system_model import can_be_declared, write_model
from rossmarie.starter.commands import (
    FastestCommand,
    are_commands,
    chosen,
    commands_of_nobody,
    commands_on,
    proposal,
)
from rossmarie.starter.errors import NothingToWatch
from rossmarie.starter.kinds import ARM, KINDS, OWN
from rossmarie.starter.names import UniqueNames, name_of
from rossmarie.starter.numbers import FEWEST, is_steady, timeout_s
from rossmarie.starter.robot import (
    BoundedCommands,
    MessageRules,
    ProposedRules,
    RobotTopics,
    WatchedTopic,
)
from rossmarie.starter.writing import SourceRecording, write_rules

READING_S = 20.0
"""The longest time in s for reading a recording, however large."""


@dataclass(frozen=True)
class Beginning:
    """The texts of a system model, of definitions by their types, and of rules. `topic_map` maps
    topics of the rules to recorded topics with other names.
    """

    model: str
    definitions: Mapping[str, str]
    rules: str
    inputs: int
    proposals: int
    topic_map: Mapping[str, str]


def begin(recording: Recording, seconds: float = READING_S) -> Beginning:
    """Read a recording for a limited time in seconds, and write first rules. Raises
    `RecordingError`.
    """
    definitions = recording.definitions()
    topics = [
        each
        for each in recording.topics.values()
        if each.count and can_be_declared(each, definitions)
    ]
    kinds = {each.name: KINDS[each.message_type or ""]() for each in _known(topics)}
    wanted = {each.name: FastestCommand() for each in topics if are_commands(each)}
    observers: dict[str, Observe] = {name: each.see for name, each in kinds.items()}
    observers |= {name: each.see for name, each in wanted.items()}
    survey = recording.survey(observers, seconds)
    # raises an error for a table, which has no types
    model = write_model(recording, definitions, survey.frames)
    names = UniqueNames()
    watched = list(_watched(topics, kinds, survey, names))
    if not any(each.is_steady for each in watched):
        raise _nothing(recording, watched)
    commands, recorded = _commands(topics, watched)
    robot = RobotTopics(watched, commands, names)
    proposals: dict[str, list[ProposedRules]] = {
        each.topic: list(each.kind.proposals(each, robot)) for each in watched
    }
    types = {_absolute(each.name): each.message_type for each in topics}
    if recorded is not None and _is_free(commands, types):
        proposals[commands.topic] = [proposal(robot, wanted, recorded)]
    has_own = any(_absolute(each.name) == OWN for each in topics)
    source = SourceRecording(
        recording.path.name, _unread(recording, survey), OWN if has_own else None
    )
    return Beginning(
        model,
        definitions,
        write_rules(source, robot, proposals),
        sum(each.is_steady for each in watched),
        sum(map(len, proposals.values())),
        {each.topic: each.recorded for each in watched if each.topic != each.recorded},
    )


def _known(topics: Sequence[RecordedTopic]) -> Iterator[RecordedTopic]:
    """The topics with messages that have a kind, in the order of the types. Of equivalent names,
    the first counts.
    """
    order = list(KINDS)
    found = [each for each in topics if each.message_type in KINDS and _absolute(each.name) != OWN]
    seen: set[str] = set()
    for each in sorted(found, key=lambda each: (order.index(each.message_type or ""), each.name)):
        if _absolute(each.name) not in seen:
            seen.add(_absolute(each.name))
            yield each


def _watched(
    topics: Sequence[RecordedTopic],
    kinds: Mapping[str, MessageRules],
    survey: Survey,
    names: UniqueNames,
) -> Iterator[WatchedTopic]:
    types = {each.name: each.message_type or "" for each in topics}
    for recorded, kind in kinds.items():
        rhythm = survey.rhythms.get(recorded)
        if rhythm is None or rhythm.count < 2:
            continue
        topic = _absolute(recorded)
        alike = [_absolute(name) for name, each in kinds.items() if each.word == kind.word]
        name = names.take(name_of(topic, kind.word, alike))
        yield WatchedTopic(
            topic,
            recorded,
            types[recorded],
            kind,
            name,
            rhythm,
            timeout_s(rhythm),
            is_steady(rhythm),
        )


def _commands(
    topics: Sequence[RecordedTopic], watched: Sequence[WatchedTopic]
) -> tuple[BoundedCommands, str | None]:
    """The actions that bound commands, and the recorded topic of these commands, or None."""
    found = [each for each in topics if are_commands(each)]
    topic = chosen(found)
    if topic is None:
        is_arm = {each.kind.word for each in watched} <= ARM
        return commands_of_nobody(is_arm, {_absolute(each.name) for each in topics}), None
    others = [_absolute(each.name) for each in found if each is not topic]
    return commands_on(_absolute(topic.name), topic.message_type or "", others), topic.name


def _is_free(commands: BoundedCommands, types: Mapping[str, str | None]) -> bool:
    """Say whether no message of another type uses the topic on which commands enter the filter."""
    return types.get(commands.entry, commands.message_type) == commands.message_type


def _absolute(topic: str) -> str:
    return topic if topic.startswith("/") else f"/{topic}"


def _unread(recording: Recording, survey: Survey) -> str | None:
    """The part of the recording that was read, in words; None for the whole recording."""
    if survey.is_whole:
        return None
    read, whole = ((end - recording.start_ns) / 1e9 for end in (survey.end_ns, recording.end_ns))
    return f"the first {read:.0f} s of {whole:.0f} s"


def _nothing(recording: Recording, watched: Sequence[WatchedTopic]) -> RecordingError:
    reason = "it holds none of the messages that a rule watches for silence"
    if watched or any(each.message_type in KINDS for each in recording.topics.values()):
        reason = f"no topic has {FEWEST} messages or more, one about as long after the other"
    types = {each.message_type or "?" for each in recording.topics.values()}
    finding = NothingToWatch(reason=reason, known=listed(KINDS), recorded=listed(sorted(types)))
    return RecordingError(at_file(finding, recording.path))
