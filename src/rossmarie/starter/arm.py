"""Rules about the joints and the forces of an arm."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rossmarie.starter.numbers import plain, rounded_up
from rossmarie.starter.robot import ProposedRules, RobotTopics, WatchedTopic

_ROOM = 1.2
_UNITS = {"position": "rad", "velocity": "rad/s", "effort": "Nm"}
_PARAMETERS = ("base", "shoulder", "elbow", "wrist_1", "wrist_2", "wrist_3")
_NAMED = re.compile(r"shoulder_pan|shoulder_lift|elbow|wrist_1|wrist_2|wrist_3")
_NUMBERED = re.compile(r"\D*([1-7])\D*$")


class Joints:
    """The state of joints: the fields that have a number for each joint, in all messages."""

    word = "joints"

    def __init__(self) -> None:
        self.names: Sequence[str] = ()
        self.largest: dict[str, float] | None = None

    def see(self, message: Any) -> None:
        """Process a message: the names of its joints, and their largest numbers."""
        self.names = self.names or tuple(message.name)
        count = len(message.name)
        found = {
            field: max((abs(each) for each in getattr(message, field)), default=0.0)
            for field in _UNITS
            if len(getattr(message, field)) == count > 0
        }
        before = found if self.largest is None else self.largest
        self.largest = {
            field: max(number, before[field])
            for field, number in found.items()
            if field in before and math.isfinite(number)
        }

    def fields(self, name: str) -> Mapping[str, str]:
        """An input for the positions, and one input for each field with nonzero numbers."""
        filled = [each for each, most in (self.largest or {}).items() if most or each == "position"]
        inputs = {f"{name}_{each}": f".{each} in {_UNITS[each]}" for each in filled}
        return inputs or {f"{name}_state": ""}

    def proposals(self, watched: WatchedTopic, robot: RobotTopics) -> Iterator[ProposedRules]:
        """Proposals for fast and loaded joints. If the names of the joints identify an arm, also
        the rules of the library.
        """
        commands, filled = robot.commands, self.largest or {}
        if filled.get("velocity"):
            limit = rounded_up(max(filled["velocity"] * _ROOM, 0.1))
            yield ProposedRules(
                f"The fastest joint in the recording: {plain(filled['velocity'])} rad/s.",
                f"rule {robot.rule(watched, 'fast_joint')}:"
                f" if any(abs({watched.name}_velocity) > {plain(limit)} rad/s) for 0.05 sec"
                f" then {{ {commands.stop}; }} clear for 1 sec;",
            )
        if filled.get("effort"):
            limit = rounded_up(max(filled["effort"] * _ROOM, 1.0))
            yield ProposedRules(
                f"The largest torque in the recording: {plain(filled['effort'])} Nm. Some drivers"
                " give currents: then the unit of the input is A.",
                f"rule {robot.rule(watched, 'strained_joint')}:"
                f" if any(abs({watched.name}_effort) > {plain(limit)} Nm) for 0.1 sec"
                f" then {{ {commands.slow}; }} clear for 1 sec;",
            )
        if not commands.is_twist:
            yield from self._imports(watched, robot)

    def _imports(self, watched: WatchedTopic, robot: RobotTopics) -> Iterator[ProposedRules]:
        named = _by_parameter(self.names)
        filled = self.largest or {}
        if {"position", "velocity"} <= filled.keys() and len(named) >= len(_PARAMETERS) - 1:
            yield self._import("joints", _PARAMETERS[:-1], named, watched, robot)
        if "effort" in filled and len(named) == len(_PARAMETERS):
            yield self._import("torque", _PARAMETERS, named, watched, robot)

    def _import(
        self,
        file: str,
        parameters: Sequence[str],
        named: Mapping[str, str],
        watched: WatchedTopic,
        robot: RobotTopics,
    ) -> ProposedRules:
        names = ", ".join(f'{each} = "{named[each]}"' for each in parameters)
        return ProposedRules(
            "Set the limits to those of your arm.",
            f'import "rossmarie/arm/{file}.ross" with joints = {watched.topic},'
            f" servo = {robot.commands.topic}, {names} as {robot.rule(watched, f'arm_{file}')};",
        )


def _by_parameter(names: Sequence[str]) -> dict[str, str]:
    """The joints of an arm by the parameters of the library. The joints of a UR are identified by
    words, the joints of other arms by numbers.
    """
    usable = [name for name in names if '"' not in name and name.isprintable()]
    found = {each[0]: name for name in usable if (each := _NAMED.search(name))}
    words = _NAMED.pattern.split("|")
    if len(found) == len(words):
        return dict(zip(_PARAMETERS, map(found.__getitem__, words), strict=True))
    numbered = {int(each[1]): name for name in usable if (each := _NUMBERED.match(name))}
    # The third joint of an arm with seven joints is an additional rotation of its upper arm.
    numbers = {7: (1, 2, 4, 5, 6, 7), 6: (1, 2, 3, 4, 5, 6)}.get(len(numbered), ())
    if len(usable) != len(numbered) or not all(each in numbered for each in numbers):
        return {}
    return {name: numbered[each] for name, each in zip(_PARAMETERS, numbers, strict=False)}


class WristForces:
    """The forces at a wrist. `path` leads to them from a message."""

    word = "wrench"

    def __init__(self, path: str) -> None:
        self._path = path
        self.largest = 0.0

    def see(self, message: Any) -> None:
        """Process a message: its force in N."""
        force = (message.wrench if self._path else message).force
        size = math.hypot(force.x, force.y, force.z)
        if math.isfinite(size):
            self.largest = max(self.largest, size)

    def fields(self, name: str) -> Mapping[str, str]:
        """The inputs for force and torque."""
        return {name: self._path}

    def proposals(self, watched: WatchedTopic, robot: RobotTopics) -> Iterator[ProposedRules]:
        """Proposals for contact."""
        commands = robot.commands
        limit = rounded_up(max(self.largest * _ROOM, 1.0))
        yield ProposedRules(
            f"The largest force in the recording: {plain(self.largest)} N.",
            f"rule {robot.rule(watched, 'contact')}: if norm({watched.name}.force) >"
            f" {plain(limit)} N then {{ {commands.stop}; }} clear for 1 sec;",
        )
        if self._path and not commands.is_twist:
            yield ProposedRules(
                "Contact, clamping and collisions. Set the limits to those of your task.",
                f'import "rossmarie/arm/force.ross" with wrench = {watched.topic},'
                f" servo = {commands.topic}, contact = {plain(limit)} N"
                f" as {robot.rule(watched, 'touch')};",
            )
