"""Units as data. `algebra` creates them; every later stage reads them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

BASE_DIMENSIONS = ("mass", "length", "angle", "current", "temperature", "luminosity", "time")


def format_product(factors: Iterable[tuple[str, int]]) -> str:
    """`kg*m^2/s` for kg to the 1, m to the 2 and s to the -1; powers of 0 are left out.

    Without positive powers, the first factor keeps its sign: `m^-1/s`. Without factors, the text is
    empty.
    """
    factors = [factor for factor in factors if factor[1] != 0]
    above = [_power(name, exponent) for name, exponent in factors if exponent > 0]
    below = [(name, exponent) for name, exponent in factors if exponent < 0]
    if not above and below:
        name, exponent = below.pop(0)
        above = [f"{name}^{exponent}"]
    return "/".join(["*".join(above), *(_power(name, -exponent) for name, exponent in below)])


def _power(name: str, exponent: int) -> str:
    return name if exponent == 1 else f"{name}^{exponent}"


@dataclass(frozen=True)
class Dimension:
    """The dimension of a quantity: an exponent for each of `BASE_DIMENSIONS`, in their order."""

    exponents: tuple[int, ...]

    def __str__(self) -> str:
        """`length/time`, `mass*length/time^2`, `dimensionless`."""
        return format_product(zip(BASE_DIMENSIONS, self.exponents, strict=True)) or "dimensionless"


@dataclass(frozen=True)
class Unit:
    """A unit of measurement; a number x in it is `x * scale + offset` in SI units.

    SI here means kg, m, rad, A, K, cd, s and their products. `symbol` is the canonical spelling
    (`m/s` for `m.sec^-1`), which `parse_unit` can read; the symbol of plain numbers is `1`. Only
    temperatures have an offset.
    """

    symbol: str
    dimension: Dimension
    scale: float = 1.0
    offset: float = 0.0

    def __str__(self) -> str:
        return self.symbol

    def to_si(self, number: float) -> float:
        """Convert a number in this unit to SI units."""
        return number * self.scale + self.offset

    def from_si(self, number: float) -> float:
        """Convert a number in SI units to this unit."""
        return (number - self.offset) / self.scale


DIMENSIONLESS = Unit("1", Dimension((0,) * len(BASE_DIMENSIONS)))


class UnknownUnitError(ValueError):
    """A unit that the table does not know, or a product that cannot be formed.

    `text` is the whole unit as written, `part` the wrong factor (all of `text` if the product is
    wrong), `suggestions` are known units to write instead of `text`, best first.
    """

    def __init__(self, text: str, part: str, suggestions: Sequence[str] = ()) -> None:
        where = "" if part == text else f" in {text!r}"
        super().__init__(f"unknown unit {part!r}{where}")
        self.text = text
        self.part = part
        self.suggestions = tuple(suggestions)
