"""Values that the solver of tests chooses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Variable:
    """Something to choose: `kind` is `slot`, `element` (`index` of an array, `part` the element),
    `angle` (`index` of the signal), `side` (`index` of the list of a scan), `rate`, `previous`,
    `aged`, `oscillating` or `remembered` (`index` of the signal, of the input, or of the
    proposition, which may count edges as well).
    """

    kind: str
    index: int
    part: int = 0


Values = Mapping[Variable, float]
"""Values in SI; propositions and texts by their numbers."""


@dataclass(frozen=True)
class Ramp:
    """Messages `step_s` apart, with which a number rises or falls: one before the value that it is
    about, and `count` behind it.
    """

    step_s: float
    count: int
