"""The core: what every function of the language means, in a handful of operations.

Nothing here knows of messages, rules or targets. The numbered rules of
`docs/explanation/semantics.md` name these definitions.
"""

from rossmarie.core.finite import may_be_infinite, rounds, shown_by
from rossmarie.core.functions import FUNCTIONS, AnyFunction, Function, Row, defined, parameters, row
from rossmarie.core.regions import Measure, Polygon, Region, RegionFunction
from rossmarie.core.sampling import MOST_SAMPLES, SAMPLINGS, Sampling, View, sampling_row

__all__ = [
    "FUNCTIONS",
    "MOST_SAMPLES",
    "SAMPLINGS",
    "AnyFunction",
    "Function",
    "Measure",
    "Polygon",
    "Region",
    "RegionFunction",
    "Row",
    "Sampling",
    "View",
    "defined",
    "may_be_infinite",
    "parameters",
    "rounds",
    "row",
    "sampling_row",
    "shown_by",
]
