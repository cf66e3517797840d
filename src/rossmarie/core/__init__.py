"""The core: every function of the language as a few basic operations.

The core does not depend on messages, rules or targets. The numbered rules of
`docs/explanation/semantics.md` name these definitions.
"""

from rossmarie.core.finite import may_be_infinite, rounds, shown_by
from rossmarie.core.functions import (
    FUNCTIONS,
    AnyFunction,
    Function,
    FunctionRow,
    defined,
    parameters,
    row,
)
from rossmarie.core.regions import Region, RegionFunction, RegionMeasure
from rossmarie.core.sampling import MOST_SAMPLES, SAMPLINGS, SampleNumber, Sampling, sampling_row
from rossmarie.core.shapes import Circle, Polygon, Rectangle, Shape

__all__ = [
    "FUNCTIONS",
    "MOST_SAMPLES",
    "SAMPLINGS",
    "AnyFunction",
    "Circle",
    "Function",
    "FunctionRow",
    "Polygon",
    "Rectangle",
    "Region",
    "RegionFunction",
    "RegionMeasure",
    "SampleNumber",
    "Sampling",
    "Shape",
    "defined",
    "may_be_infinite",
    "parameters",
    "rounds",
    "row",
    "sampling_row",
    "shown_by",
]
