"""Names for the declarations of a rules file, each of its own."""

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

_SHORTEST = 3
"""The letters of an abbreviation."""


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


def name_of(topic: str, word: str, alike: Collection[str]) -> str:
    """A name for the messages on a topic, one of those `alike` that have messages of one kind: the
    word for that kind, and the parts of the topic that tell it from the others: `imu_front` for
    `/front/imu/data` beside `/rear/imu/data`.
    """
    if len(alike) == 1:
        return word
    shared = set(_words(topic)).intersection(*map(_words, alike))
    own = [each for each in _words(topic) if each not in shared and not _means(each, word)]
    return "_".join([word, *own])


def _words(topic: str) -> list[str]:
    return [each for each in re.split(r"[/_]+", topic) if each]


def _means(part: str, word: str) -> bool:
    """Say whether a part of a topic says what the word says, as `odom` of `odometry`."""
    return part == "data" or (len(part) >= _SHORTEST and word.startswith(part))
