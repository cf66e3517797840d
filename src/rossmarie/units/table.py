"""The units that rules may use, one row for each, derived from SI (BIPM brochure, 9th edition).

A unit is `numerator / denominator * pi**pi_power` times a product of the units above it. Two kinds
are left out on purpose: `C` (coulomb), which users write for degrees Celsius, and units that REP
103 advises against.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple


class Definition(NamedTuple):
    """The meaning of a symbol; an empty product marks a base unit or a plain number."""

    meaning: str
    product: str = ""
    numerator: int = 1
    denominator: int = 1
    pi_power: int = 0
    offset: float = 0.0


BASE_UNITS = ("kg", "m", "rad", "A", "K", "cd", "s")
"""The SI units of `BASE_DIMENSIONS`, in the same order."""

SYMBOLS: Mapping[str, Definition] = {
    # length
    "m": Definition("metre"),
    "km": Definition("kilometre", "m", 1000),
    "cm": Definition("centimetre", "m", 1, 100),
    "mm": Definition("millimetre", "m", 1, 1000),
    "um": Definition("micrometre", "m", 1, 10**6),
    "nm": Definition("nanometre", "m", 1, 10**9),
    # time and frequency
    "s": Definition("second"),
    "ms": Definition("millisecond", "s", 1, 1000),
    "us": Definition("microsecond", "s", 1, 10**6),
    "ns": Definition("nanosecond", "s", 1, 10**9),
    "min": Definition("minute", "s", 60),
    "h": Definition("hour", "s", 3600),
    "Hz": Definition("hertz", "s^-1"),
    "kHz": Definition("kilohertz", "s^-1", 1000),
    "MHz": Definition("megahertz", "s^-1", 10**6),
    # angle
    "rad": Definition("radian"),
    "mrad": Definition("milliradian", "rad", 1, 1000),
    "deg": Definition("degree", "rad", 1, 180, pi_power=1),
    "rev": Definition("revolution", "rad", 2, pi_power=1),
    "rpm": Definition("revolutions per minute", "rad/s", 1, 30, pi_power=1),
    # mass, force, torque, pressure
    "kg": Definition("kilogram"),
    "g": Definition("gram", "kg", 1, 1000),
    "mg": Definition("milligram", "kg", 1, 10**6),
    "N": Definition("newton", "kg*m/s^2"),
    "mN": Definition("millinewton", "kg*m/s^2", 1, 1000),
    "kN": Definition("kilonewton", "kg*m/s^2", 1000),
    "g0": Definition("standard gravity", "m/s^2", 980665, 100000),
    "Pa": Definition("pascal", "kg/m/s^2"),
    "hPa": Definition("hectopascal", "kg/m/s^2", 100),
    "kPa": Definition("kilopascal", "kg/m/s^2", 1000),
    "MPa": Definition("megapascal", "kg/m/s^2", 10**6),
    "mbar": Definition("millibar", "kg/m/s^2", 100),
    "bar": Definition("bar", "kg/m/s^2", 100000),
    # energy and power
    "J": Definition("joule", "kg*m^2/s^2"),
    "kJ": Definition("kilojoule", "kg*m^2/s^2", 1000),
    "Wh": Definition("watt hour", "kg*m^2/s^2", 3600),
    "kWh": Definition("kilowatt hour", "kg*m^2/s^2", 3600000),
    "W": Definition("watt", "kg*m^2/s^3"),
    "mW": Definition("milliwatt", "kg*m^2/s^3", 1, 1000),
    "kW": Definition("kilowatt", "kg*m^2/s^3", 1000),
    # electricity and magnetism
    "A": Definition("ampere"),
    "mA": Definition("milliampere", "A", 1, 1000),
    "uA": Definition("microampere", "A", 1, 10**6),
    "Ah": Definition("ampere hour", "A*s", 3600),
    "mAh": Definition("milliampere hour", "A*s", 36, 10),
    "V": Definition("volt", "kg*m^2/s^3/A"),
    "mV": Definition("millivolt", "kg*m^2/s^3/A", 1, 1000),
    "kV": Definition("kilovolt", "kg*m^2/s^3/A", 1000),
    "ohm": Definition("ohm", "kg*m^2/s^3/A^2"),
    "kohm": Definition("kiloohm", "kg*m^2/s^3/A^2", 1000),
    "T": Definition("tesla", "kg/s^2/A"),
    "mT": Definition("millitesla", "kg/s^2/A", 1, 1000),
    "uT": Definition("microtesla", "kg/s^2/A", 1, 10**6),
    # temperature and light
    "K": Definition("kelvin"),
    "degC": Definition("degree Celsius", "K", offset=273.15),
    "cd": Definition("candela"),
    "lx": Definition("lux", "cd/m^2"),
    # ratios
    "%": Definition("percent", "", 1, 100),
}

ALIASES: Mapping[str, str] = {
    "sec": "s",
    "msec": "ms",
    "usec": "us",
    "nsec": "ns",
    "\N{MICRO SIGN}s": "us",
    "\N{MICRO SIGN}m": "um",
    "\N{MICRO SIGN}T": "uT",
    "\N{GREEK SMALL LETTER MU}s": "us",
    "\N{GREEK SMALL LETTER MU}m": "um",
    "\N{GREEK SMALL LETTER MU}T": "uT",
    "°": "deg",
    "°C": "degC",
    "\N{OHM SIGN}": "ohm",
    "\N{GREEK CAPITAL LETTER OMEGA}": "ohm",
    "Nm": "N*m",
    "mNm": "mN*m",
    "kNm": "kN*m",
    "Nms": "N*m*s",
    "Ns": "N*s",
    "kgm": "kg*m",
}
"""Other notations, and products that are written without a sign."""

PREFERRED = ("Hz", "N", "N*m", "Pa", "W", "V", "ohm", "T", "lx")
"""The names of SI units that people use instead of products of base units."""

SPELLED_OUT: Mapping[str, str] = {
    "C": "degC",
    "celsius": "degC",
    "degree": "deg",
    "degrees": "deg",
    "hr": "h",
    "hours": "h",
    "lux": "lx",
    "meter": "m",
    "meters": "m",
    "metres": "m",
    "minutes": "min",
    "percent": "%",
    "radians": "rad",
    "seconds": "s",
    "secs": "s",
}
"""The suggestions for notations that are not accepted, in addition to the meanings of `SYMBOLS`."""

EVERYDAY: Mapping[str, str] = {
    "mps": "m/s",
    "kmh": "km/h",
    "kph": "km/h",
    "kmph": "km/h",
    "mps2": "m/s^2",
    "mins": "min",
    "hrs": "h",
    "millis": "ms",
    "micros": "us",
    "nanos": "ns",
    "degs": "deg",
    "dps": "deg/s",
    "degps": "deg/s",
    "rads": "rad",
    "radps": "rad/s",
    "rps": "rev/s",
    "revs": "rev",
}
"""Everyday notations, in lower case, with their meanings. They take precedence."""

FACTORS: Mapping[str, str] = {
    "mph": "1 mph is 0.44704 m/s, or 1.609344 km/h",
    "kt": "1 knot is 1.852 km/h",
    "knot": "1 knot is 1.852 km/h",
    "knots": "1 knot is 1.852 km/h",
    "mi": "1 mile is 1.609344 km",
    "mile": "1 mile is 1.609344 km",
    "miles": "1 mile is 1.609344 km",
    "yd": "1 yd is 0.9144 m",
    "ft": "1 ft is 0.3048 m",
    "foot": "1 ft is 0.3048 m",
    "feet": "1 ft is 0.3048 m",
    "inch": "1 inch is 2.54 cm",
    "inches": "1 inch is 2.54 cm",
    "lb": "1 lb is 0.45359237 kg",
    "lbs": "1 lb is 0.45359237 kg",
    "lbf": "1 lbf is 4.4482216 N",
    "psi": "1 psi is 6.894757 kPa",
    "degf": "X degF are (X - 32) / 1.8 degC",
}
"""Units that are not supported, in lower case, with their values in supported units."""
