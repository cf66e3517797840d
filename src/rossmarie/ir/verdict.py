"""The verdicts of a monitor: a rule became active or was cleared, with the instant and the causes.

Every target yields exactly the same values.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass


class TruthValue(enum.IntEnum):
    """Kleene's three truth values. Unknown has two forms; STALE means that an input with a timeout
    is missing.

    With these numbers, conjunction and disjunction are maxima, see `docs/explanation/semantics.md`.
    """

    FALSE = 0
    TRUE = 1
    UNKNOWN = 2
    STALE = 3


class Change(enum.IntEnum):
    """The change of a rule."""

    CLEARED = 0
    ACTIVATED = 1
    ACTIVATED_STALE = 2


class InputState(enum.IntEnum):
    """The state of an input."""

    NEVER = 0
    FRESH = 1
    EXPIRED = 2


@dataclass(frozen=True)
class Verdict:
    """One change of one rule, with a snapshot of the values that the rule depends on.

    `propositions[i]` and `since_ns[i]`, the instant since which it has had this value, belong to
    `rule.terms[i]`; `values[i]` belongs to `rule.signals[i]` (SI; NaN is unknown); `inputs[i]`
    belongs to `rule.inputs[i]`.
    """

    rule: int
    at_ns: int
    change: Change
    truth_values: tuple[TruthValue, ...]
    since_ns: tuple[int, ...]
    values: tuple[float, ...]
    inputs: tuple[InputState, ...]


@dataclass(frozen=True)
class TimeJump:
    """Time went backwards: all durations start again."""

    from_ns: int
    to_ns: int


Event = Verdict | TimeJump
