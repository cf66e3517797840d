"""Quantities written as texts, `30 N`: a closed table of units, and their values in SI units.

A unit is `numerator / denominator * pi**pi_power` times the SI unit of its dimension.
"""

from __future__ import annotations

import enum
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple


class Dimension(enum.Enum):
    """The kinds of quantities; the values are their SI units."""

    LENGTH = "m"
    MASS = "kg"
    TIME = "s"
    FORCE = "N"
    ANGLE = "rad"
    SPEED = "m/s"
    TURN = "rad/s"


class Unit(NamedTuple):
    """A unit, by its dimension and scale."""

    dimension: Dimension
    numerator: int = 1
    denominator: int = 1
    pi_power: int = 0

    def si(self, value: float) -> float:
        """A value in SI units. The result is rounded once, except for units with pi. It may be
        infinite.
        """
        exact = Fraction(value) * Fraction(self.numerator, self.denominator)
        try:
            return float(exact) * math.pi**self.pi_power
        except OverflowError:
            return math.inf


UNITS: Mapping[str, Unit] = {
    "m": Unit(Dimension.LENGTH),
    "km": Unit(Dimension.LENGTH, 1000),
    "cm": Unit(Dimension.LENGTH, 1, 100),
    "mm": Unit(Dimension.LENGTH, 1, 1000),
    "kg": Unit(Dimension.MASS),
    "g": Unit(Dimension.MASS, 1, 1000),
    "s": Unit(Dimension.TIME),
    "ms": Unit(Dimension.TIME, 1, 1000),
    "N": Unit(Dimension.FORCE),
    "kN": Unit(Dimension.FORCE, 1000),
    "mN": Unit(Dimension.FORCE, 1, 1000),
    "rad": Unit(Dimension.ANGLE),
    "deg": Unit(Dimension.ANGLE, 1, 180, 1),
    "m/s": Unit(Dimension.SPEED),
    "cm/s": Unit(Dimension.SPEED, 1, 100),
    "mm/s": Unit(Dimension.SPEED, 1, 1000),
    "km/h": Unit(Dimension.SPEED, 10, 36),
    "rad/s": Unit(Dimension.TURN),
    "deg/s": Unit(Dimension.TURN, 1, 180, 1),
    "rpm": Unit(Dimension.TURN, 1, 30, 1),
}
"""All known units. Rules use the same units with the same meanings."""

_QUANTITY = re.compile(
    r"(?P<number>[-+]?(?:[0-9]+(?:\.[0-9]*)?(?:[eE][-+]?[0-9]+)?|(?i:nan|inf(?:inity)?)))"
    r"(?:(?<=[0-9.])|\s|$)\s*(?P<unit>.*)",
    re.DOTALL,
)


@dataclass(frozen=True)
class Quantity:
    """A number with a unit, and its value in SI units."""

    value: float
    unit: str
    si: float


@dataclass(frozen=True)
class Written:
    """The parts of a text that looks like a quantity; `unit` is empty if there is none."""

    number: float
    unit: str
    has_minus: bool


def read(text: str) -> Written | None:
    """The parts of a quantity; None if the text does not begin with a number."""
    found = _QUANTITY.fullmatch(text.strip())
    if found is None:
        return None
    number = found["number"]
    return Written(float(number), found["unit"], number.startswith("-"))


def units_of(*dimensions: Dimension) -> list[str]:
    """The units of some dimensions, the SI units first."""
    known = [name for name, unit in UNITS.items() if unit.dimension in dimensions]
    return sorted(known, key=lambda name: name not in {each.value for each in dimensions})
