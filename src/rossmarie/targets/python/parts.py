"""Parts that a generated module may need, word for word: the generator copies these by their
source.

They mean what `docs/explanation/semantics.md` says, with 0 for false, 1 for true, 2 for unknown and
3 for lost.
"""

from __future__ import annotations

import math
from collections import deque
from typing import NamedTuple

NAN = math.nan
INF = math.inf


class Verdict(NamedTuple):
    """A rule changed: 0 cleared, 1 activated, 2 activated for lack of an input with a timeout.

    `truths[i]` is what `RULES[rule].terms[i]` was (0 false, 1 true, 2 unknown, 3 lost) and
    `since_ns[i]` since when, `values[i]` is `RULES[rule].signals[i]` in SI units (NaN is unknown),
    `inputs[i]` the state of `RULES[rule].inputs[i]` (0 never received, 1 fresh, 2 expired).
    """

    rule: int
    at_ns: int
    change: int
    truths: tuple[int, ...]
    since_ns: tuple[int, ...]
    values: tuple[float, ...]
    inputs: tuple[int, ...]


class TimeJump(NamedTuple):
    """Time went backwards: every duration starts again."""

    from_ns: int
    to_ns: int


class Rule(NamedTuple):
    """What a rule is called, what it asks for, and what its verdicts speak of."""

    name: str
    actions: tuple[str, ...]
    terms: tuple[str, ...]
    signals: tuple[str, ...]
    inputs: tuple[str, ...]


def known(value: float) -> float:
    """Not finite is not known."""
    return value if value - value == 0.0 else NAN


def divide(a: float, b: float) -> float:
    """A quotient as IEEE 754 has it, where Python raises."""
    if b != 0.0:
        return a / b
    return NAN if a == 0.0 or a != a else math.copysign(INF, a) * math.copysign(1.0, b)


def square_root(x: float) -> float:
    """A square root; NaN below zero, where Python raises."""
    return math.sqrt(x) if x >= 0.0 else NAN


class Samples:
    """The last two samples of a signal, or with a window those in it, 64 at the most."""

    def __init__(self, window_ns: int = 0) -> None:
        self.window_ns = window_ns
        self.kept: deque[tuple[int, float]] = deque(maxlen=64 if window_ns else 2)

    def forget(self) -> None:
        """There are none."""
        self.kept.clear()

    def take(self, value: float, at_ns: int) -> None:
        """A sample; at an equal instant it replaces the last one."""
        kept = self.kept
        if kept and kept[-1][0] == at_ns:
            kept.pop()
        while self.window_ns and kept and at_ns - kept[0][0] >= self.window_ns:
            kept.popleft()
        kept.append((at_ns, value))

    def newest(self) -> float:
        """NaN if there is none."""
        return self.kept[-1][1] if self.kept else NAN

    def before(self) -> float:
        """The sample before the newest; NaN if there is none."""
        return self.kept[-2][1] if len(self.kept) > 1 else NAN

    def seconds(self) -> float:
        """The time between these two; NaN if they are not there."""
        return (self.kept[-1][0] - self.kept[-2][0]) / 1e9 if len(self.kept) > 1 else NAN

    def lower(self) -> float:
        """The middle by size, of two the lower; NaN if any sample is, or there is none."""
        return self.ranked((len(self.kept) - 1) // 2)

    def upper(self) -> float:
        """The middle by size, of two the upper; NaN if any sample is, or there is none."""
        return self.ranked(len(self.kept) // 2)

    def ranked(self, rank: int) -> float:
        """The sample with so many others before it by size; of equals, the earlier."""
        values = [value for _, value in self.kept]
        if not values or any(value != value for value in values):
            return NAN
        return sorted(values)[rank]


class Oscillation:
    """The turning points of a signal. `direction` is 1 upwards, -1 downwards, 0 not known; `gap` is
    what the condition was when the signal was last not finite, and `gap_end_ns` when that ended.
    """

    def __init__(self, count: int, window_ns: int, swing: float) -> None:
        self.turns: deque[int] = deque(maxlen=count)
        self.window_ns = window_ns
        self.swing = swing
        self.forget(0, 0)

    def forget(self, gap: int, gap_end_ns: int | None) -> None:
        """Nothing is known of the signal any more."""
        self.turns.clear()
        self.direction = 0
        self.extreme = NAN
        self.gap = gap
        self.gap_end_ns = gap_end_ns

    def take(self, x: float, at_ns: int) -> None:
        """A finite sample."""
        going = self.direction
        if self.extreme != self.extreme or going * x > going * self.extreme:
            self.extreme = x
        elif going != 1 and x > self.extreme + self.swing:
            self.turn(1, x, at_ns)
        elif going != -1 and x < self.extreme - self.swing:
            self.turn(-1, x, at_ns)

    def turn(self, direction: int, x: float, at_ns: int) -> None:
        """From now on it goes this way."""
        if self.direction != 0:
            self.turns.append(at_ns)
        self.direction = direction
        self.extreme = x

    def look(self, at_ns: int) -> int:
        """Whether enough turning points lie in the window, the signal being finite."""
        if self.gap_end_ns is None:
            self.gap_end_ns = at_ns
        if self.is_swinging() and at_ns - self.turns[0] < self.window_ns:
            return 1
        return self.gap if at_ns - self.gap_end_ns < self.window_ns else 0

    def is_swinging(self) -> bool:
        """Whether there are enough turning points."""
        return len(self.turns) == self.turns.maxlen

    def wake_ns(self, truth: int, never_ns: int) -> int:
        """When the condition, which is `truth`, may change by itself."""
        if truth == 1:
            return self.turns[0] + self.window_ns
        if truth < 2 or self.gap_end_ns is None:
            return never_ns
        return self.gap_end_ns + self.window_ns
