"""Requirements of rules, with the way on which the robot brakes, worked out step by step."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rossmarie import ir
from rossmarie.analysis.errors import NotInTime, Undecided
from rossmarie.analysis.finding import Finding

_OUTCOMES = {NotInTime.code: "refuted", Undecided.code: "not decided"}
_SPEEDS = 4
"""So many measured speeds have their way in the table, the fastest among them."""


@dataclass(frozen=True)
class Way:
    """The way on which a motion slows down from a measured speed, in words."""

    speed: str
    reached: str
    until_brakes: str
    braking: str
    all: str


@dataclass(frozen=True)
class Kept:
    """A requirement, whether it holds, what it rests on in words, and the ways."""

    required: ir.Requirement
    outcome: str
    assumptions: tuple[str, ...]
    ways: tuple[Way, ...]


def kept(required: ir.Requirement, findings: Sequence[Finding]) -> Kept:
    """A requirement as a safety file tells of it; `findings` are those on the rules."""
    codes = {
        each.diagnostic.code for each in findings if each.diagnostic.primary.span == required.span
    }
    outcome = next((words for code, words in _OUTCOMES.items() if code in codes), "proved")
    ways = tuple(_way(required, number) for number in range(1, _SPEEDS + 1))
    return Kept(required, outcome, tuple(_assumptions(required.braking)), ways)


def _assumptions(braking: ir.Braking) -> Iterator[str]:
    yield f"The position is {braking.position}, the speed {braking.speed}."
    yield (
        f"The brakes hold {braking.reaction_s:g} s after a message at the latest: a message is "
        f"missed after {braking.timeout_s:g} s, and the latency is {braking.latency_s:g} s."
    )
    yield (
        f"Until then the speed can grow by {braking.acceleration:g} m/s^2, up to "
        f"{braking.fastest:g} m/s. After that it falls by {braking.brake:g} m/s^2 or more."
    )
    if not braking.is_of_one_message:
        yield (
            "Position and speed come in different messages. So the way until the brakes hold is "
            f"that at {braking.fastest:g} m/s."
        )


def _way(required: ir.Requirement, number: int) -> Way:
    braking = required.braking
    speed = braking.fastest * number / _SPEEDS
    reached = braking.reached(speed)
    way = braking.way(speed, required.speed)
    until = braking.way_until_brakes(speed) if way else 0.0
    return Way(
        f"{speed:.3g} m/s",
        f"{reached:.3g} m/s",
        f"{until:.3g} m",
        f"{way - until:.3g} m",
        f"{way:.3g} m",
    )
