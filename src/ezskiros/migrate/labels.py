"""Labels of conditions that add information to the condition itself."""

from __future__ import annotations

import re
from collections.abc import Iterable

_FILLING = {"a", "at", "be", "cond", "condition", "for", "has", "have", "hold", "in", "is", "must"}
_FILLING |= {"of", "on", "post", "pre", "should", "the", "to", "with"}
_OPPOSITE = {"no", "not", "non", "un"}


def says_more(label: str, said: Iterable[str], *, is_true: bool) -> bool:
    """Say whether a label has a word, not just a letter, that is not among the words of its
    condition.

    `RobotAt` only repeats that the robot is at a location; `EmptyHanded` adds information.
    """
    known = {word for text in said for word in _words(text)}
    allowed = _FILLING if is_true else _FILLING | _OPPOSITE
    return any(
        len(word) > 1
        and word not in allowed
        and not any(_is_form_of(word, other) for other in known)
        for word in _words(label)
    )


def _words(text: str) -> list[str]:
    """The words of a text: `EEHasGripper2` has the words ee, has, gripper and 2."""
    found = re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+|[^\W\d_a-zA-Z]+", text)
    return [word.lower() for word in found]


def _is_form_of(word: str, other: str) -> bool:
    """Say whether two words are forms of one word: contained and contain, obj and object."""
    return other.startswith(word) or (len(other) > 2 and word in _forms(other))


def _forms(word: str) -> set[str]:
    return {word, *(word + ending for ending in ("s", "d", "ed", "ing"))}
