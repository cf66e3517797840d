"""The effects of the loss of an input on the rules, as the queries find them."""

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
    """The effects of the loss of an input, by rule, without the rules that it does not affect.

    `after_ns` is the age of the input in ns at which all effects have happened; None if the input
    is never stale.
    """

    input: int
    after_ns: int | None
    effects: Mapping[int, Effect]

    def rules(self, effect: Effect) -> tuple[int, ...]:
        """The rules on which the loss has this effect."""
        return tuple(rule for rule, found in self.effects.items() if found is effect)
