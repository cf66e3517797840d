"""Variables whose values the solver of tests chooses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Variable:
    """A variable of the solver. `kind` determines the meaning of `index`.

    - `slot`: a slot.
    - `element`: an array; `part` is the index of the element.
    - `angle`, `rate`, `previous`: a signal.
    - `side`: the list of a scan.
    - `aged`: an input.
    - `oscillating`, `remembered`: a proposition; an `oscillating` one may also count edges.
    """

    kind: str
    index: int
    part: int = 0


Values = Mapping[Variable, float]
"""Values in SI; propositions and texts are numbers."""


@dataclass(frozen=True)
class Ramp:
    """Messages `step_s` apart, with which a number rises or falls: one before the value of
    interest, and `count` after it.
    """

    step_s: float
    count: int
