"""The feedback of rules for a learner; no monitor heeds it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Margin:
    """The distance of a rule's condition to where it changes: a signal, and how it is shown
    (`value * scale` in `unit`).
    """

    signal: int
    unit: str
    scale: float


@dataclass(frozen=True)
class Feedback:
    """The loss of a learner by a rule: each time that it becomes active, and while it is active.
    Beside it a learner is told the margin, if the rule declares it.
    """

    per_activation: float = 0.0
    per_second: float = 0.0
    margin: Margin | None = None


NO_FEEDBACK = Feedback()
