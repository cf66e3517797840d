"""The margins of thresholds, in readable numbers and units."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rossmarie import ir
from rossmarie.testing.margins import ThresholdMargin, ValueRange

Range = tuple[float | None, float | None]
"""The two ends of a range; None means no limit."""

MEANING = (
    "Between the first two values every verdict stays as it is, to the instant; between the "
    "last two each rule becomes active and is cleared as often, perhaps earlier or later."
)


@dataclass(frozen=True)
class Spare:
    """A threshold or a duration with its value and two ranges of its values. Within `same`, all
    verdicts are equal; within the other range, each rule has equally many activations.
    """

    name: str
    unit: str
    value: float
    same: Range
    as_often: Range

    @property
    def cells(self) -> tuple[str, ...]:
        """The name, and the four ends, in the user's notation."""
        return tuple(
            "any" if each is None else f"{each:.6g} {self.unit}".strip()
            for each in (self.value, *self.same, *self.as_often)
        )


def spares(machine: ir.Machine, margins: Sequence[ThresholdMargin]) -> Iterator[Spare]:
    """The margins of a machine, in their order."""
    for each in margins:
        constant = each.threshold.constant
        shown = None if constant is None else machine.signals[constant]
        yield Spare(
            name=each.threshold.text,
            unit="s" if shown is None else shown.unit,
            value=_shown(shown, each.threshold.value),
            same=_range(shown, each.same),
            as_often=_range(shown, each.as_often),
        )


def _range(shown: ir.Signal | None, reach: ValueRange) -> Range:
    low, high = (None if end is None else _shown(shown, end) for end in (reach.low, reach.high))
    return low, high


def _shown(shown: ir.Signal | None, value: float) -> float:
    return value if shown is None else float(f"{value * shown.scale + shown.offset:.12g}")


def read_spare(found: Mapping[str, object]) -> Spare:
    """A spare from the JSON form of `asdict`. Raises `ValueError` for wrong values, and other
    errors for a wrong shape.
    """
    return Spare(
        name=_text(found["name"]),
        unit=_text(found["unit"]),
        value=_number(found["value"]),
        same=_read_range(found["same"]),
        as_often=_read_range(found["as_often"]),
    )


def _read_range(found: object) -> Range:
    if not isinstance(found, list) or len(found) != 2:
        raise ValueError("a margin has no two ends")
    low, high = (None if end is None else _number(end) for end in found)
    return low, high


def _text(value: object) -> str:
    if not isinstance(value, str):
        raise ValueError("a margin has something else where a string should be")
    return value


def _number(value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise ValueError("a margin has something else where a number should be")
    return float(value)
