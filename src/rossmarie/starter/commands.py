"""The topic of commands that first rules bound."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from rossmarie.recordings.model import RecordedTopic
from rossmarie.starter.numbers import plain, rounded_up
from rossmarie.starter.robot import UNFILTERED, BoundedCommands, ProposedRules, RobotTopics

TYPES = ("geometry_msgs/Twist", "geometry_msgs/TwistStamped")
_TWIST, _STAMPED = TYPES
_WORDS = ("cmd", "command")
_USUAL = "cmd_vel"
_ROOM = 1.2
_SILENCE_S = 1


@dataclass
class FastestCommand:
    """The fastest command of a recording, in m/s."""

    fastest: float = 0.0

    def see(self, message: Any) -> None:
        """Process a message."""
        linear = getattr(message, "twist", message).linear
        speed = math.hypot(linear.x, linear.y, linear.z)
        if math.isfinite(speed):
            self.fastest = max(self.fastest, speed)


def are_commands(topic: RecordedTopic) -> bool:
    """Say whether the messages on a topic are velocity commands."""
    last = topic.name.rpartition("/")[2]
    is_named_so = any(word in last for word in _WORDS) and not last.startswith(UNFILTERED)
    return topic.message_type in TYPES and is_named_so


def chosen(topics: Sequence[RecordedTopic]) -> RecordedTopic | None:
    """The command topic that most likely reaches the robot. A topic with the usual name comes
    first, then the topic with the most messages.
    """

    def rank(topic: RecordedTopic) -> tuple[bool, int, int, str]:
        parts = topic.name.split("/")
        return parts[-1] == _USUAL, topic.count, len(parts), topic.name

    return max(topics, key=rank, default=None)


def commands_on(name: str, message_type: str, others: Sequence[str]) -> BoundedCommands:
    """The actions that bound the commands on a recorded topic."""
    about = "The commands of the planner pass through the filter of the rules on this topic."
    if others:
        about += f" Also recorded: {', '.join(others)}. Name the one that the robot itself obeys."
    if message_type == _TWIST:
        declared = f'import "rossmarie/deros.ross" with cmd_vel = {name};'
        return BoundedCommands(name, message_type, about, declared, "stop", "lowSpeed")
    declared = f'import "rossmarie/commands.ross" with commands = {name};'
    return BoundedCommands(name, message_type, about, declared, "hold", "slow")


def commands_of_nobody(is_arm: bool, others: Collection[str]) -> BoundedCommands:
    """The actions for commands that are not recorded. `others` are the recorded topics."""
    if is_arm:
        name = _free("/servo_node/delta_twist_cmds", others)
        about = f"The recording has no commands; {name} is that of MoveIt Servo: name yours."
        declared = f'import "rossmarie/arm.ross" with servo = {name};'
        return BoundedCommands(name, _STAMPED, about, declared, "standStill", "constrainedMotion")
    name = _free("/cmd_vel", others)
    about = f"The recording has no commands; {name} is the usual topic of a base: name yours."
    declared = f'import "rossmarie/deros.ross" with cmd_vel = {name};'
    return BoundedCommands(name, _TWIST, about, declared, "stop", "lowSpeed")


def _free(topic: str, others: Collection[str]) -> str:
    """A topic; if messages of another type use it, a topic in a namespace."""
    while topic in others:
        topic = f"/robot{topic}"
    return topic


def proposal(
    robot: RobotTopics, wanted: Mapping[str, FastestCommand], recorded: str
) -> ProposedRules:
    """A proposal for a limit of commands."""
    commands = robot.commands
    fastest = wanted[recorded].fastest
    name, rule = robot.names.take("command"), robot.names.take("commanded_too_fast")
    limit = rounded_up(max(fastest * _ROOM, 0.1))
    path = ".linear" if commands.is_twist else ".twist.linear"
    return ProposedRules(
        f"The fastest command in the recording: {plain(fastest)} m/s. Commands enter the filter as"
        f" {commands.entry}: give `replay` --topic-map {commands.entry}={recorded}."
        " A planner that is silent longer than the timeout is held.",
        f"input {name} = topic {commands.entry} : {commands.message_type} {path}"
        f" timeout {_SILENCE_S} sec;\n"
        f"rule {rule}: if norm({name}) > {plain(limit)} m/s then {{ {commands.slow}; }}"
        " clear for 1 sec;",
    )
