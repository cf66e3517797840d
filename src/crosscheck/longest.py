"""The longest times that a behavior tree can take until it succeeds, and until it fails.

A step may take any time and may succeed or fail. Only deadlines bound the steps. A tick is assumed
to need no time. For a node without memory, which restarts all its children at each tick, the time
is a lower bound.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

Part = tuple[str, float]
"""The words for some steps, and the seconds that they take."""


@dataclass(frozen=True)
class Time:
    """A number of seconds, and the parts that add up to it; infinite if nothing bounds the time."""

    seconds: float
    parts: tuple[Part, ...] = ()

    def then(self, other: Time) -> Time:
        """The sum of two times, one after the other."""
        return Time(self.seconds + other.seconds, self.parts + other.parts)


@dataclass(frozen=True)
class Longest:
    """The longest times of a tree until success and failure. None means that the result is
    impossible.
    """

    success: Time | None
    failure: Time | None

    @property
    def end(self) -> Time:
        """The longest time until the tree succeeds or fails."""
        return _latest(self.failure, self.success) or _AT_ONCE


_AT_ONCE = Time(0.0)
_NEVER = Time(math.inf)
STEP = Longest(_NEVER, _NEVER)
"""A step without a deadline."""


def either(alternatives: Iterable[Longest]) -> Longest:
    """The times if the chosen branch is unknown."""
    known = [*alternatives]
    success = _latest(*(each.success for each in known))
    return Longest(success, _latest(*(each.failure for each in known)))


def in_turn(children: Iterable[Longest]) -> Longest:
    """The times of a sequence: it succeeds with its last child, and fails with any child."""
    success: Time | None = _AT_ONCE
    failure: Time | None = None
    for each in children:
        if success is None:
            break
        failure = _latest(failure, each.failure and success.then(each.failure))
        success = each.success and success.then(each.success)
    return Longest(success, failure)


def turned(child: Longest) -> Longest:
    """The times with success and failure exchanged."""
    return Longest(child.failure, child.success)


def until_one(children: Iterable[Longest]) -> Longest:
    """The times of a selector: it fails with its last child, and succeeds with any child."""
    return turned(in_turn(map(turned, children)))


def never_failing(children: Iterable[Longest]) -> Longest:
    """The times of a sequence that reports a failure as success."""
    return Longest(in_turn(children).end, None)


def at_once(children: Sequence[Longest]) -> Longest:
    """The times of parallel children that end if one fails or all have succeeded."""
    successes = [each.success for each in children]
    success = None if None in successes else _latest(_AT_ONCE, *successes)
    # A child that cannot succeed ends all children with its failure, at the latest at the end of
    # its own time.
    latest = _earliest(*(each.failure for each in children if each.success is None))
    failures = (each.failure for each in children)
    return Longest(success, _latest(*(each and _earliest(each, latest) for each in failures)))


def until_first(children: Sequence[Longest]) -> Longest:
    """The times of parallel children that end if one ends."""
    if not children:
        return Longest(_AT_ONCE, None)
    latest = _earliest(*(each.end for each in children))
    success = _latest(*(each.success and _earliest(each.success, latest) for each in children))
    return Longest(
        success, _latest(*(each.failure and _earliest(each.failure, latest) for each in children))
    )


def within(seconds: float, child: Longest, words: str) -> Longest:
    """The times below a deadline, which fails a child without a result."""
    over = Time(seconds, ((words, seconds),))
    success = child.success and _earliest(child.success, over)
    return Longest(success, over if child.end.seconds > seconds else child.failure)


def again(tries: int, child: Longest, words: str) -> Longest:
    """The times of a child that is restarted after a failure."""
    if child.failure is None or tries <= 1:
        return child
    failed, before = (_times(number, child.failure, words) for number in (tries, tries - 1))
    return Longest(child.success and before.then(child.success), failed)


def _times(number: int, time: Time, words: str) -> Time:
    seconds = time.seconds * number
    return Time(seconds, ((f"{number} x {words}" if number > 1 else words, seconds),))


def _latest(*times: Time | None) -> Time | None:
    known = (each for each in times if each is not None)
    return max(known, key=lambda each: each.seconds, default=None)


def _earliest(*times: Time | None) -> Time | None:
    known = (each for each in times if each is not None)
    return min(known, key=lambda each: each.seconds, default=None)
