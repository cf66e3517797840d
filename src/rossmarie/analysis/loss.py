"""What the loss of an input does to the rules, as it was found out."""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass


class Effect(enum.Enum):
    """What the loss of an input does to a rule."""

    ACTIVATES = "becomes active"
    DEPENDS = "depends on other inputs"
    NOTHING = "does nothing"


@dataclass(frozen=True)
class Loss:
    """What the loss of an input does, by rule; rules to which it does nothing are left out.

    `after_ns` is the age at which all of it has happened, None if the input is never lost.
    """

    input: int
    after_ns: int | None
    effects: Mapping[int, Effect]

    def rules(self, effect: Effect) -> tuple[int, ...]:
        """The rules to which this happens."""
        return tuple(rule for rule, found in self.effects.items() if found is effect)
