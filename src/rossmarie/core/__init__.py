"""The core: what every function of the language means, in a handful of operations.

Nothing here knows of messages, rules or targets. The numbered rules of
`docs/explanation/semantics.md` name these definitions.
"""

from rossmarie.core.finite import may_be_infinite, rounds, shown_by
from rossmarie.core.functions import FUNCTIONS, Function, Row, defined, parameters, row

__all__ = [
    "FUNCTIONS",
    "Function",
    "Row",
    "defined",
    "may_be_infinite",
    "parameters",
    "rounds",
    "row",
    "shown_by",
]
