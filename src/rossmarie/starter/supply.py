"""Rules about the batteries, the temperatures and the diagnostics of any robot."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from rossmarie.starter.numbers import plain, rounded_down
from rossmarie.starter.robot import ProposedRules, RobotTopics, WatchedTopic

_FEWEST_STATUSES = 16


class Battery:
    """The charge of a battery."""

    word = "battery"

    def __init__(self) -> None:
        self.lowest = math.inf
        self.weakest = math.inf
        self.is_share = True

    def see(self, message: Any) -> None:
        """Process a message: its charge, from 0 to 1, and its voltage in V."""
        charge, voltage = message.percentage, message.voltage
        self.is_share &= 0 < charge <= 1  # false for NaN
        self.lowest = min(self.lowest, charge)
        if voltage > 0:
            self.weakest = min(self.weakest, voltage)

    def fields(self, name: str) -> Mapping[str, str]:
        """An input for the whole message."""
        return {name: ""}

    def proposals(self, watched: WatchedTopic, robot: RobotTopics) -> Iterator[ProposedRules]:
        """A proposal for a low battery, by its charge or, if the charge is unknown, by its
        voltage.
        """
        name, commands = watched.name, robot.commands
        volts = rounded_down(self.weakest * 0.9) if math.isfinite(self.weakest) else None
        rule = robot.rule(watched, "battery_low")
        then = f"then {{ {commands.slow}; }} clear for 10 sec;"
        if self.is_share and math.isfinite(self.lowest):
            yield ProposedRules(
                f"The lowest charge in the recording: {self.lowest * 100:.0f} %.",
                f"rule {rule}: if {name}.percentage < 15 % for 5 sec {then}",
            )
        elif volts is not None:
            yield ProposedRules(
                "This battery does not tell its charge as a share from 0 to 1. Its lowest voltage"
                f" in the recording: {plain(self.weakest)} V.",
                f"rule {rule}: if {name}.voltage < {plain(volts)} V for 5 sec {then}",
            )
        if self.is_share and volts is not None:
            yield ProposedRules(
                "An empty, a hot and a strained battery. Set the limits to those of your battery.",
                f'import "rossmarie/power/battery.ross" with battery_state = {watched.topic},'
                f" commands = {commands.topic}, weakest = {plain(volts)} V"
                f" as {robot.rule(watched, 'charge')};",
            )


class Heat:
    """The temperature of a part."""

    word = "temperature"

    def __init__(self) -> None:
        self.hottest = -math.inf

    def see(self, message: Any) -> None:
        """Process a message: its temperature in degC."""
        if math.isfinite(message.temperature):
            self.hottest = max(self.hottest, message.temperature)

    def fields(self, name: str) -> Mapping[str, str]:
        """An input for the temperature."""
        return {name: ".temperature"}

    def proposals(self, watched: WatchedTopic, robot: RobotTopics) -> Iterator[ProposedRules]:
        """A proposal for a hot part."""
        if not math.isfinite(self.hottest):
            return
        commands = robot.commands
        limit = max(60, 5 * math.ceil((self.hottest + 10) / 5))
        yield ProposedRules(
            f"The hottest in the recording: {plain(self.hottest)} degC.",
            f"rule {robot.rule(watched, 'hot')}: if {watched.name} > {limit} degC for 2 sec"
            f" then {{ {commands.slow}; }} clear for 10 sec;",
        )
        yield ProposedRules(
            "Hot parts, and sensors that are broken.",
            f'import "rossmarie/health/temperature.ross" with sensor = {watched.topic},'
            f" commands = {commands.topic}, warm = {limit} degC, hot = {limit + 20} degC"
            f" as {robot.rule(watched, 'heat')};",
        )


class Diagnostics:
    """The statuses that parts report."""

    word = "diagnostics"

    def __init__(self) -> None:
        self.most = 0

    def see(self, message: Any) -> None:
        """Process a message: its number of statuses."""
        self.most = max(self.most, len(message.status))

    def fields(self, name: str) -> Mapping[str, str]:
        """An input for the statuses: twice as many as in the recording."""
        bound = _FEWEST_STATUSES
        while bound < 2 * self.most:
            bound *= 2
        return {name: f".status up to {bound}"}

    def proposals(self, watched: WatchedTopic, robot: RobotTopics) -> Iterator[ProposedRules]:
        """A proposal for a part with an error."""
        commands = robot.commands
        yield ProposedRules(
            f"The most statuses in a message of the recording: {self.most}.",
            f"rule {robot.rule(watched, 'defective')}: if any(part in {watched.name}:"
            f" part.level == DiagnosticStatus.ERROR) then {{ {commands.slow}; }} clear for 2 sec;",
        )
        yield ProposedRules(
            "Parts that are defective, or silent.",
            f'import "rossmarie/health/diagnostics.ross" with diagnostics = {watched.topic},'
            f" commands = {commands.topic} as {robot.rule(watched, 'parts')};",
        )
