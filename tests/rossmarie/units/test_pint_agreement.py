"""pint, which others maintain, is the oracle of our table."""

from __future__ import annotations

import math
from typing import Any, TypeAlias

import pint
import pytest

from rossmarie.units import ALIASES, SYMBOLS, parse_unit

Registry: TypeAlias = "pint.UnitRegistry[Any]"

NAMES_IN_PINT = {
    "g0": "standard_gravity",
    "%": "percent",
    "degC": "delta_degC",
    "rev": "revolution",
}
DIMENSIONS_IN_PINT = {
    "mass": "[mass]",
    "length": "[length]",
    "current": "[current]",
    "temperature": "[temperature]",
    "luminosity": "[luminosity]",
    "time": "[time]",
}


@pytest.fixture(scope="module")
def registry() -> Registry:
    return pint.UnitRegistry()


@pytest.mark.parametrize("symbol", SYMBOLS)
def test_pint_agrees(registry: Registry, symbol: str) -> None:
    ours = parse_unit(symbol)
    theirs = registry.Quantity(1.0, NAMES_IN_PINT.get(symbol, symbol))
    base = theirs.to_base_units()
    # The base units of pint are those of SI, but for angles, which are plain numbers there.
    assert math.isclose(ours.scale, base.magnitude, rel_tol=1e-15)
    expected = {
        DIMENSIONS_IN_PINT[name]: exponent
        for name, exponent in _dimension(symbol)
        if name != "angle"
    }
    assert dict(theirs.dimensionality) == expected


def test_pint_agrees_on_celsius(registry: Registry) -> None:
    kelvin = registry.Quantity(21.5, "degC").to("K").magnitude
    assert parse_unit("degC").to_si(21.5) == kelvin


@pytest.mark.parametrize("angle", ["rad", "mrad", "deg", "rev", "rpm"])
def test_angles_are_what_pint_calls_radians(registry: Registry, angle: str) -> None:
    theirs = registry.Quantity(1.0, NAMES_IN_PINT.get(angle, angle))
    assert "radian" in str(theirs.to_base_units().units)
    assert "angle" in str(parse_unit(angle).dimension)


@pytest.mark.parametrize("product", ["km/h", "kWh/km", "mN*m", "rpm/s", "deg/s^2", "Ah/h"])
def test_pint_agrees_on_products(registry: Registry, product: str) -> None:
    theirs = registry.Quantity(1.0, product.replace("Ah", "ampere_hour")).to_base_units()
    assert math.isclose(parse_unit(product).scale, theirs.magnitude, rel_tol=1e-15)


def test_every_alias_stands_for_known_symbols() -> None:
    assert all(parse_unit(alias) == parse_unit(meaning) for alias, meaning in ALIASES.items())


def _dimension(symbol: str) -> list[tuple[str, int]]:
    from rossmarie.units.model import BASE_DIMENSIONS

    exponents = parse_unit(symbol).dimension.exponents
    return [(n, e) for n, e in zip(BASE_DIMENSIONS, exponents, strict=True) if e]
