"""The facts about the robot of a recording that first rules need."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

from rossmarie.recordings.model import Rhythm
from rossmarie.starter.names import UniqueNames

UNFILTERED = "unfil_"
"""The prefix of the topic on which commands enter the filter of a topic."""


@dataclass(frozen=True)
class ProposedRules:
    """Rules that may fit a robot, and a sentence or two about the rules."""

    about: str
    code: str


@dataclass(frozen=True)
class BoundedCommands:
    """The topic of the commands that rules bound, and the actions that bound them.

    `declared` brings the actions into a rules file. `field` is a field of the messages, with the
    topic.
    """

    topic: str
    message_type: str
    about: str
    declared: str
    stop: str
    slow: str

    @property
    def is_twist(self) -> bool:
        """Say whether library rules for a base fit."""
        return self.message_type == "geometry_msgs/Twist"

    @property
    def entry(self) -> str:
        """The topic on which commands enter the filter of the rules."""
        folder, _, last = self.topic.rpartition("/")
        return f"{folder}/{UNFILTERED}{last}"

    @property
    def field(self) -> str:
        """A field that is zero while the robot stands still."""
        return "linear.x" if self.is_twist else "twist.linear.x"


class MessageRules(Protocol):
    """The rules about messages of a type, with limits from the messages on one topic."""

    @property
    def word(self) -> str:
        """A name for such messages, if only one topic has messages of this kind."""

    def see(self, message: Any) -> None:
        """Process a message."""

    def fields(self, name: str) -> Mapping[str, str]:
        """The inputs by name, each with its field and unit."""

    def proposals(self, watched: WatchedTopic, robot: RobotTopics) -> Iterator[ProposedRules]:
        """Proposals for rules that may fit the robot."""


@dataclass(frozen=True)
class WatchedTopic:
    """A topic whose messages rules read. `recorded` is its name in the recording."""

    topic: str
    recorded: str
    message_type: str
    kind: MessageRules
    name: str
    rhythm: Rhythm
    timeout: float
    is_steady: bool

    def named(self, word: str) -> str:
        """A name for a rule about this topic."""
        return word if self.name == self.kind.word else f"{self.name}_{word}"


@dataclass(frozen=True)
class RobotTopics:
    """The topics of a robot that rules read, and the topic of its commands."""

    watched: Sequence[WatchedTopic]
    commands: BoundedCommands
    names: UniqueNames = field(default_factory=UniqueNames)

    def of_word(self, word: str) -> Sequence[WatchedTopic]:
        """The topics with messages of a kind."""
        return [each for each in self.watched if each.kind.word == word]

    def rule(self, watched: WatchedTopic, word: str) -> str:
        """A unique name for a rule or an import about a topic."""
        return self.names.take(watched.named(word))
