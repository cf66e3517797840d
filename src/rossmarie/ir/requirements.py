"""Requirements of rules: each rule acts before it is too late."""

from __future__ import annotations

from dataclasses import dataclass

from dslkit.source import Span
from rossmarie.ir.model import Machine


@dataclass(frozen=True)
class Braking:
    """The braking of a motion, in SI. `brake` is the least deceleration, `timeout_s` the longest
    silence of its messages, and `latency_s` all other time from a message to the brakes. `position`
    and `speed` are in the words of the rules. Unless `is_of_one_message`, they arrive in separate
    messages.
    """

    motion: str
    position: str
    speed: str
    brake: float
    acceleration: float
    fastest: float
    timeout_s: float
    latency_s: float
    is_of_one_message: bool

    @property
    def reaction_s(self) -> float:
        """The longest time in s from the state in the last message to the brakes."""
        return self.timeout_s + self.latency_s

    def reached(self, speed: float) -> float:
        """The speed in m/s at which the brakes take hold, for a measured speed."""
        return min(abs(speed) + self.acceleration * self.reaction_s, self.fastest)

    def distance_until_brakes(self, speed: float) -> float:
        """The distance in m until the brakes take hold, for a measured speed."""
        travelling = self.reached(speed) if self.is_of_one_message else self.fastest
        return travelling * self.reaction_s

    def distance(self, speed: float, wanted: float) -> float:
        """The distance in m in which a measured speed falls to the wanted speed, by rule S65."""
        reached = self.reached(speed)
        braking = (reached * reached - wanted * wanted) / (2.0 * self.brake)
        return self.distance_until_brakes(speed) + braking if reached > wanted else 0.0


@dataclass(frozen=True)
class Requirement:
    """A rule keeps a motion below `speed` m/s in the locations of a class: it is active before it
    is too late to brake. `machine` is the machine of the rules with additional propositions. Its
    proposition `truth` means that it is too late and the condition of the rule is false. `text` is
    the requirement as written, at `span`; `rule` is the name of the rule.
    """

    rule: str
    text: str
    span: Span
    speed: float
    places: str
    braking: Braking
    machine: Machine
    proposition: int
