"""The feedback of rules to a learner (thesis, section 6.3): the cost of a step, and margins."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rossmarie.ir import Machine, margins_of

Active = NDArray[np.bool_]
Floats = NDArray[np.float64]


class FeedbackMeter:
    """The amounts of all rules. The meter works on one guard, with arrays of shape (rules,), and on
    several guards, with arrays of shape (n, rules).
    """

    def __init__(self, machine: Machine) -> None:
        amounts = [rule.feedback for rule in machine.rules]
        self.rules = len(amounts)
        self._per_activation = np.array([each.per_activation for each in amounts], np.float64)
        self._per_second = np.array([each.per_second for each in amounts], np.float64)
        self._margin_scales = np.array([each.scale for each in margins_of(machine)], np.float64)
        self.declared_margins = len(self._margin_scales)

    def between(self, before: Active, after: Active, elapsed_ns: Any) -> Floats:
        """The feedback of each rule from one observation to the next: an amount for a rule that
        became active, and an amount per second for a rule that was active. `elapsed_ns` is a
        number, or of shape (n,).
        """
        if not before.any() and not after.any():
            return np.zeros(np.shape(before))
        seconds = np.asarray(elapsed_ns, np.float64)[..., None] / 1e9
        lasting = before * (self._per_second * seconds)
        found: Floats = (after & ~before) * self._per_activation + lasting
        return found

    def margins(self, numbers: Floats) -> Floats:
        """The declared margins, each in its unit. `numbers` are the margins in SI units, of shape
        (margins,) or (n, margins).
        """
        with np.errstate(over="ignore"):
            found: Floats = numbers * self._margin_scales
        return found


def rules_with_margin(machine: Machine) -> tuple[str, ...]:
    """The names of the rules that declare a margin, in the order of margins."""
    return tuple(rule.name for rule in machine.rules if rule.feedback.margin is not None)
