"""The feedback of rules to a learner. Monitors ignore it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Margin:
    """The distance of a rule's condition to the point where its value changes: a signal, and its
    display (`value * scale` in `unit`).
    """

    signal: int
    unit: str
    scale: float


@dataclass(frozen=True)
class Feedback:
    """The cost of a rule to a learner: for each activation, and per second while the rule is
    active. The learner also gets the margin, if the rule declares one.
    """

    per_activation: float = 0.0
    per_second: float = 0.0
    margin: Margin | None = None


NO_FEEDBACK = Feedback()
