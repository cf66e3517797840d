"""The effects of the loss of an input on the rules, as they were found out."""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass


class Effect(enum.Enum):
    """The effect of the loss of an input on a rule."""

    ACTIVATES = "becomes active"
    DEPENDS = "depends on other inputs"
    NOTHING = "does nothing"


@dataclass(frozen=True)
class Loss:
    """The effects of the loss of an input, by rule; rules that it does not affect are left out.

    `after_ns` is the age at which all of it has happened, None if the input is never stale.
    """

    input: int
    after_ns: int | None
    effects: Mapping[int, Effect]

    def rules(self, effect: Effect) -> tuple[int, ...]:
        """The rules to which this happens."""
        return tuple(rule for rule, found in self.effects.items() if found is effect)
