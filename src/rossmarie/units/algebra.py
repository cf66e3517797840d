"""Parses units, and computes products of units.

Every unit is a product of powers of the symbols of `table`. Scales are multiplied as ratios of
integers and rounded once, so `km/h`, `deg/s` and similar units are the nearest doubles to the exact
values.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache, lru_cache

from rossmarie.units.model import (
    BASE_DIMENSIONS,
    DIMENSIONLESS,
    Dimension,
    Unit,
    UnknownUnitError,
    format_product,
)
from rossmarie.units.suggest import suggest
from rossmarie.units.table import ALIASES, BASE_UNITS, PREFERRED, SYMBOLS

Factors = dict[str, int]

_FACTOR = re.compile(r"(?P<symbol>[^\W\d_]\w*|[%°]\w*)(\^(?P<exponent>-?[1-9][0-9]?))?")
_SEPARATOR = re.compile(r"([.*/])")

# 50 digits: enough for pi times any ratio below to round to the nearest double.
_PI_NUMERATOR = 314159265358979323846264338327950288419716939937510
_PI_DENOMINATOR = 10**50

# Every scale is within 1e-9 .. 1e9, so that a product of many scales is still a normal double.
_MOST_FACTORS = 32


@lru_cache(maxsize=1024)
def parse_unit(text: str) -> Unit:
    """The unit written as `text`: `m/s^2`, `N*m`, `kgm.m`, `m.s^-1`, `rad/sec`, `degC`, `1`.

    Factors are separated by `*`, `.` or `/`, which apply from left to right. A factor is a symbol,
    optionally with a power. Raises `UnknownUnitError`, also for `degC` inside a product and for
    extreme powers.
    """
    if text == DIMENSIONLESS.symbol:
        return DIMENSIONLESS
    factors = _parse(text)
    if sum(map(abs, factors.values())) > _MOST_FACTORS:
        raise UnknownUnitError(text, text)
    if len(factors) > 1 or sum(factors.values()) != 1:
        for symbol in factors:
            if SYMBOLS[symbol].offset:
                in_kelvin = format_product(_without_offsets(factors).items())
                raise UnknownUnitError(text, symbol, (in_kelvin,))
    return _unit(factors)


def multiply(left: Unit, right: Unit) -> Unit:
    """The unit of products: `m/s` times `s` is `m`. Temperatures count as kelvin."""
    return _product(left.symbol, right.symbol, 1)


def divide(left: Unit, right: Unit) -> Unit:
    """The unit of quotients: `m` by `s` is `m/s`. Temperatures count as kelvin."""
    return _product(left.symbol, right.symbol, -1)


def unit_of_differences(unit: Unit) -> Unit:
    """The unit of the difference of two numbers in `unit`: kelvin for `degC`, else `unit`
    itself.
    """
    return si_unit(unit.dimension) if unit.offset else unit


@lru_cache(maxsize=1024)
def si_unit(dimension: Dimension) -> Unit:
    """The SI unit of a dimension, by its usual name: `N`, `N*m`, `Hz`, `m/s`."""
    for name in PREFERRED:
        unit = parse_unit(name)
        if unit.dimension == dimension:
            return unit
    symbol = format_product(zip(BASE_UNITS, dimension.exponents, strict=True))
    return Unit(symbol, dimension) if symbol else DIMENSIONLESS


def _parse(text: str) -> Factors:
    parts = _SEPARATOR.split(text)
    factors: Factors = {}
    sign = 1
    for index, part in enumerate(parts):
        if index % 2 == 1:
            sign = -1 if part == "/" else 1
            continue
        match = _FACTOR.fullmatch(part)
        known = _expand(match["symbol"]) if match else None
        if match is None or known is None:
            near = [each for found in suggest(text, _is_unit) for each in _in_kelvin(found)]
            raise UnknownUnitError(text, part or text, tuple(near))
        _add(factors, known, sign * int(match["exponent"] or 1))
    return factors


def _in_kelvin(unit: str) -> tuple[str, ...]:
    """The unit; in a product, temperatures are replaced by kelvin."""
    try:
        parse_unit(unit)
    except UnknownUnitError as error:
        return error.suggestions
    return (unit,)


def _is_unit(text: str) -> bool:
    """Say whether `text` consists of known symbols. The function never searches for suggestions."""
    matches = [_FACTOR.fullmatch(part) for part in _SEPARATOR.split(text)[::2]]
    return all(match is not None and _expand(match["symbol"]) is not None for match in matches)


def _expand(symbol: str) -> Factors | None:
    if symbol in SYMBOLS:
        return {symbol: 1}
    product = ALIASES.get(symbol)
    return None if product is None else _known(product)


def _known(product: str) -> Factors:
    """The factors of a canonical symbol. All its parts are known."""
    factors: Factors = {}
    for sign, part in re.findall(r"(^|[*/])([^*/]+)", product):
        symbol, _, exponent = part.partition("^")
        _add(factors, {symbol: 1}, (-1 if sign == "/" else 1) * int(exponent or 1))
    return factors


def _add(factors: Factors, more: Factors, exponent: int) -> None:
    for symbol, power in more.items():
        factors[symbol] = factors.get(symbol, 0) + power * exponent
        if factors[symbol] == 0:
            del factors[symbol]


@lru_cache(maxsize=1024)
def _product(left: str, right: str, exponent: int) -> Unit:
    factors: Factors = {}
    for symbol, sign in ((left, 1), (right, exponent)):
        if symbol != DIMENSIONLESS.symbol:
            _add(factors, _without_offsets(_known(symbol)), sign)
    return _unit(factors)


def _without_offsets(factors: Factors) -> Factors:
    result: Factors = {}
    for symbol, exponent in factors.items():
        base = SYMBOLS[symbol].product if SYMBOLS[symbol].offset else symbol
        _add(result, {base: 1}, exponent)
    return result


def _unit(factors: Factors) -> Unit:
    dimension = _dimension(factors.items())
    scale = _scale(factors)
    if scale is None:
        return si_unit(dimension)
    symbol = format_product(factors.items())
    if not symbol:
        return DIMENSIONLESS
    offset = SYMBOLS[symbol].offset if symbol in SYMBOLS else 0.0
    return Unit(symbol, dimension, scale, offset)


def _dimension(factors: Iterable[tuple[str, int]]) -> Dimension:
    exponents = [0] * len(BASE_DIMENSIONS)
    for symbol, exponent in factors:
        for base, power in _base_factors(symbol).items():
            exponents[BASE_UNITS.index(base)] += power * exponent
    return Dimension(tuple(exponents))


@cache
def _base_factors(symbol: str) -> Factors:
    if symbol in BASE_UNITS:
        return {symbol: 1}
    product = SYMBOLS[symbol].product
    return _known(product) if product else {}


def _scale(factors: Factors) -> float | None:
    """The nearest double; None if there are too many factors to compute it."""
    if sum(map(abs, factors.values())) > _MOST_FACTORS:
        return None
    numerator, denominator = 1, 1
    for symbol, exponent in factors.items():
        row = SYMBOLS[symbol]
        above = row.numerator * _PI_NUMERATOR**row.pi_power
        below = row.denominator * _PI_DENOMINATOR**row.pi_power
        if exponent < 0:
            above, below = below, above
        numerator *= above ** abs(exponent)
        denominator *= below ** abs(exponent)
    # Division of integers rounds once.
    return numerator / denominator
