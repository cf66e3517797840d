"""Parts that a generated module may need, word for word: the generator copies these by their
source.

They mean what `docs/explanation/semantics.md` says, with 0 for false, 1 for true, 2 for unknown and
3 for stale.
"""

from __future__ import annotations

import math
from collections import deque
from typing import NamedTuple

NAN = math.nan
INF = math.inf


class Verdict(NamedTuple):
    """A rule changed: 0 cleared, 1 activated, 2 activated for lack of an input with a timeout.

    `truth_values[i]` is what `RULES[rule].terms[i]` was (0 false, 1 true, 2 unknown, 3 stale) and
    `since_ns[i]` since when, `values[i]` is `RULES[rule].signals[i]` in SI units (NaN is unknown),
    `inputs[i]` the state of `RULES[rule].inputs[i]` (0 never received, 1 fresh, 2 expired).
    """

    rule: int
    at_ns: int
    change: int
    truth_values: tuple[int, ...]
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

    def total(self) -> float:
        """The sum, the oldest sample first; NaN if there is none."""
        total = NAN
        for place, (_, value) in enumerate(self.kept):
            total = total + value if place else value
        return total

    def count(self) -> float:
        """How many there are."""
        return float(len(self.kept))

    def ranked(self, rank: int) -> float:
        """The sample with so many others before it by size; of equals, the earlier."""
        values = [value for _, value in self.kept]
        if not values or any(value != value for value in values):
            return NAN
        return sorted(values)[rank]


class Recent:
    """The instants of the last few turning points or edges, counted within a window. `gap` is what
    their source was when it was last unknown, and `gap_end_ns` when that ended, None if it lasts.
    """

    def __init__(self, count: int, window_ns: int) -> None:
        self.instants: deque[int] = deque(maxlen=count)
        self.window_ns = window_ns
        self.gap = 0
        self.gap_end_ns: int | None = 0

    def forget(self, at_ns: int) -> None:
        """Nothing is known of what was before."""
        self.instants.clear()
        self.gap = 2
        self.gap_end_ns = at_ns

    def look(self, source: int, at_ns: int) -> int:
        """Say if enough lie in the window, the source of them being known or not."""
        if source > 1:
            self.gap = source
            self.gap_end_ns = None
        elif self.gap_end_ns is None:
            self.gap_end_ns = at_ns
        if self.is_full() and at_ns - self.instants[0] < self.window_ns:
            return 1
        is_over = self.gap_end_ns is not None and at_ns - self.gap_end_ns >= self.window_ns
        return 0 if is_over else self.gap

    def is_full(self) -> bool:
        """Say if there are as many as count."""
        return len(self.instants) == self.instants.maxlen

    def wake_ns(self, proposition: int, never_ns: int) -> int:
        """When the condition, which is `truth`, may change by itself."""
        if proposition == 1:
            return self.instants[0] + self.window_ns
        if proposition < 2 or self.gap_end_ns is None:
            return never_ns
        return self.gap_end_ns + self.window_ns


class Recurrence:
    """The edges of a condition, and what that was before."""

    def __init__(self, count: int, window_ns: int) -> None:
        self.recent = Recent(count, window_ns)
        self.before = 0

    def forget(self, at_ns: int) -> None:
        """Nothing is known of what was before."""
        self.before = 2
        self.recent.forget(at_ns)

    def look(self, value: int, at_ns: int) -> int:
        """Say if there were enough edges, the condition being `value`."""
        if value == 1 and self.before == 0:
            self.recent.instants.append(at_ns)
        self.before = value
        return self.recent.look(value, at_ns)


class Oscillation:
    """The turning points of a signal. `direction` is 1 upwards, -1 downwards, 0 not known."""

    def __init__(self, count: int, window_ns: int, swing: float) -> None:
        self.recent = Recent(count, window_ns)
        self.swing = swing
        self.direction = 0
        self.extreme = NAN

    def forget(self, at_ns: int) -> None:
        """Nothing is known of what was before."""
        self.clear()
        self.recent.forget(at_ns)

    def clear(self) -> None:
        """Nothing is known of the signal any more."""
        self.recent.instants.clear()
        self.direction = 0
        self.extreme = NAN

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
            self.recent.instants.append(at_ns)
        self.direction = direction
        self.extreme = x
