"""Names for what a rules file declares, each of its own."""

from __future__ import annotations

import re
from collections.abc import Collection

from rossmarie.syntax.words import RESERVED

_TAKEN = frozenset(
    {"backAway", "constrainedMotion", "controllerOk", "hold", "holdUntilReset", "lowSpeed"}
    | {"notAhead", "part", "relaxGrip", "slow", "soften", "standStill", "standUntilReset"}
    | {"stop", "stopMotor", "tell"}
)
"""The names of actions of the library, and of an element in a rule that is proposed."""


class Names:
    """Hands out each name once."""

    def __init__(self) -> None:
        self._taken = {*_TAKEN, *RESERVED}

    def take(self, wanted: str) -> str:
        """The name that is wanted, or one with a number behind it."""
        name, number = wanted, 1
        while name in self._taken:
            number += 1
            name = f"{wanted}_{number}"
        self._taken.add(name)
        return name


def name_of(topic: str, word: str, others: Collection[str]) -> str:
    """A name for the messages on a topic: the word for their kind, if no other topic has messages
    of that kind, else with the other parts of the topic: `imu_front` for `/front/imu/data`.
    """
    if not others:
        return word
    parts = [part for part in topic.split("/") if part not in ("", "data", word)]
    return re.sub(r"\W+", "_", "_".join([word, *parts]), flags=re.ASCII)
