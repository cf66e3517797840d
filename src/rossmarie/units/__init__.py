"""Units of measurement: the meaning of symbols, and the units of products.

An angle is a dimension of its own (`deg` and `rad` convert; a plain number is not an angle).
"""

from rossmarie.units.algebra import divide, multiply, parse_unit, si_unit, unit_of_differences
from rossmarie.units.model import DIMENSIONLESS, Dimension, Unit, UnknownUnitError
from rossmarie.units.suggest import factor_of
from rossmarie.units.table import ALIASES, SYMBOLS

__all__ = [
    "ALIASES",
    "DIMENSIONLESS",
    "SYMBOLS",
    "Dimension",
    "Unit",
    "UnknownUnitError",
    "divide",
    "factor_of",
    "multiply",
    "parse_unit",
    "si_unit",
    "unit_of_differences",
]
