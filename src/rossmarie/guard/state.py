"""The state of a guard, for checkpoints, copies and tests."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from rossmarie.guard.decision import Before
from rossmarie.ir import Verdict

Sizes: TypeAlias = tuple[int, int | None]
"""The sizes of an observation and an action; None if there was no action yet."""


@dataclass(frozen=True)
class GuardState:
    """The whole state of a guard. `fingerprint` identifies its rules and its kind."""

    fingerprint: str
    sizes: Sizes | None
    at_ns: int | None
    causes: Mapping[int, Verdict]
    known: Any
    seen: tuple[Before, Before] = (None, None)
    earlier: NDArray[np.float64] | None = None
    is_decided: bool = False
