"""Unique names for the declarations of a rules file."""

from __future__ import annotations

import re
from collections.abc import Collection

from rossmarie.syntax.words import RESERVED

_TAKEN = frozenset(
    {"backAway", "constrainedMotion", "controllerOk", "hold", "holdUntilReset", "lowSpeed"}
    | {"notAhead", "part", "relaxGrip", "slow", "soften", "standStill", "standUntilReset"}
    | {"stop", "stopMotor", "tell"}
)
"""The names of library actions, and the name of an element in a proposed rule."""

_SHORTEST = 3
"""The number of letters of an abbreviation."""


class UniqueNames:
    """Returns each name only once."""

    def __init__(self) -> None:
        self._taken = {*_TAKEN, *RESERVED}

    def take(self, wanted: str) -> str:
        """The wanted name, or the name with a number at the end."""
        name, number = wanted, 1
        while name in self._taken:
            number += 1
            name = f"{wanted}_{number}"
        self._taken.add(name)
        return name


def name_of(topic: str, word: str, alike: Collection[str]) -> str:
    """A name for the messages on a topic. `alike` are the topics with messages of the same kind.
    The name consists of the word for this kind, and the parts of the topic that distinguish it:
    `imu_front` for `/front/imu/data` beside `/rear/imu/data`.
    """
    if len(alike) == 1:
        return word
    shared = set(_words(topic)).intersection(*map(_words, alike))
    own = [each for each in _words(topic) if each not in shared and not _means(each, word)]
    return "_".join([word, *own])


def _words(topic: str) -> list[str]:
    return [each for each in re.split(r"[/_]+", topic) if each]


def _means(part: str, word: str) -> bool:
    """Say whether a part of a topic has the meaning of a word: `odom` means `odometry`."""
    return part == "data" or (len(part) >= _SHORTEST and word.startswith(part))
