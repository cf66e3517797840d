"""Requirements of rules, with the robot's stopping distance, calculated step by step."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rossmarie import ir
from rossmarie.analysis.errors import NotInTime
from rossmarie.report.safety.model import SafetyFile

_SPEEDS = 4
"""The number of measured speeds in the table, including the fastest."""


@dataclass(frozen=True)
class SlowingDistance:
    """The distance in which a motion slows down from a measured speed, in words."""

    speed: str
    reached: str
    until_brakes: str
    braking: str
    all: str


@dataclass(frozen=True)
class Kept:
    """A requirement with its proof status, its assumptions in words, and the distances."""

    required: ir.Requirement
    outcome: str
    assumptions: tuple[str, ...]
    distances: tuple[SlowingDistance, ...]


def kept(required: ir.Requirement, content: SafetyFile) -> Kept:
    """A requirement in the form of a safety file."""
    distances = tuple(_slowing_distance(required, number) for number in range(1, _SPEEDS + 1))
    assumptions = tuple(_assumptions(required.braking))
    return Kept(required, _outcome(required, content), assumptions, distances)


def _outcome(required: ir.Requirement, content: SafetyFile) -> str:
    if required.span in content.proved:
        return "proved"
    found = (each.diagnostic for each in content.findings)
    is_refuted = any(
        each.code == NotInTime.code and each.primary.span == required.span for each in found
    )
    return "refuted" if is_refuted else "not decided"


def _assumptions(braking: ir.Braking) -> Iterator[str]:
    yield f"The position comes from “{braking.position}”, the speed from “{braking.speed}”."
    yield (
        f"The brakes engage within {braking.reaction_s:g} s of a message: the input is stale after "
        f"{braking.timeout_s:g} s, and the latency is {braking.latency_s:g} s."
    )
    yield (
        f"Until then the speed can grow by {braking.acceleration:g} m/s^2, up to "
        f"{braking.fastest:g} m/s. After that it falls by {braking.brake:g} m/s^2 or more."
    )
    if not braking.is_of_one_message:
        yield (
            "Position and speed come in different messages. So the distance until the brakes "
            f"engage is computed at {braking.fastest:g} m/s."
        )


def _slowing_distance(required: ir.Requirement, number: int) -> SlowingDistance:
    braking = required.braking
    speed = braking.fastest * number / _SPEEDS
    reached = braking.reached(speed)
    distance = braking.distance(speed, required.speed)
    until = braking.distance_until_brakes(speed) if distance else 0.0
    return SlowingDistance(
        f"{speed:.3g} m/s",
        f"{reached:.3g} m/s",
        f"{until:.3g} m",
        f"{distance - until:.3g} m",
        f"{distance:.3g} m",
    )
