"""Optional parts of a generated module: the generator copies their source.

They implement `docs/explanation/semantics.md`, with 0 for false, 1 for true, 2 for unknown and 3
for stale.
"""

from __future__ import annotations

import math
from collections import deque
from typing import NamedTuple

NAN = math.nan
INF = math.inf


class Verdict(NamedTuple):
    """A change of a rule. `change` is 0 (cleared), 1 (activated), or 2 (activated because an input
    with a timeout is missing).

    - `truth_values[i]` is the truth value of `RULES[rule].terms[i]`: 0 false, 1 true, 2 unknown,
      3 stale. The term has this truth value since `since_ns[i]`.
    - `values[i]` is the value of `RULES[rule].signals[i]` in SI units; NaN is unknown.
    - `inputs[i]` is the state of `RULES[rule].inputs[i]`: 0 never received, 1 fresh, 2 expired.
    """

    rule: int
    at_ns: int
    change: int
    truth_values: tuple[int, ...]
    since_ns: tuple[int, ...]
    values: tuple[float, ...]
    inputs: tuple[int, ...]


class TimeJump(NamedTuple):
    """Time went backwards, so every duration starts again."""

    from_ns: int
    to_ns: int


class Rule(NamedTuple):
    """The name of a rule, its actions, and the terms of its verdicts."""

    name: str
    actions: tuple[str, ...]
    terms: tuple[str, ...]
    signals: tuple[str, ...]
    inputs: tuple[str, ...]


def known(value: float) -> float:
    """A number that is not finite is unknown."""
    return value if value - value == 0.0 else NAN


def divide(a: float, b: float) -> float:
    """A quotient as IEEE 754 defines it, where Python raises an error."""
    if b != 0.0:
        return a / b
    return NAN if a == 0.0 or a != a else math.copysign(INF, a) * math.copysign(1.0, b)


def square_root(x: float) -> float:
    """A square root; NaN below zero, where Python raises an error."""
    return math.sqrt(x) if x >= 0.0 else NAN


class Samples:
    """The last two samples of a signal or, with a window, at most 64 samples in the window."""

    def __init__(self, window_ns: int = 0) -> None:
        self.window_ns = window_ns
        self.kept: deque[tuple[int, float]] = deque(maxlen=64 if window_ns else 2)

    def forget(self) -> None:
        """Forget all samples."""
        self.kept.clear()

    def take(self, value: float, at_ns: int) -> None:
        """Take a sample. A sample at the instant of the last sample replaces that sample."""
        kept = self.kept
        if kept and kept[-1][0] == at_ns:
            kept.pop()
        while self.window_ns and kept and at_ns - kept[0][0] >= self.window_ns:
            kept.popleft()
        kept.append((at_ns, value))

    def newest(self) -> float:
        """The newest sample; NaN if there is none."""
        return self.kept[-1][1] if self.kept else NAN

    def before(self) -> float:
        """The sample before the newest; NaN if there is none."""
        return self.kept[-2][1] if len(self.kept) > 1 else NAN

    def seconds(self) -> float:
        """The time between the last two samples; NaN if one is missing."""
        return (self.kept[-1][0] - self.kept[-2][0]) / 1e9 if len(self.kept) > 1 else NAN

    def lower(self) -> float:
        """The middle sample by size, or the lower of two; NaN without samples, or with a NaN."""
        return self.ranked((len(self.kept) - 1) // 2)

    def upper(self) -> float:
        """The middle sample by size, or the upper of two; NaN without samples, or with a NaN."""
        return self.ranked(len(self.kept) // 2)

    def total(self) -> float:
        """The sum, from the oldest sample to the newest; NaN without samples."""
        total = NAN
        for place, (_, value) in enumerate(self.kept):
            total = total + value if place else value
        return total

    def count(self) -> float:
        """The number of samples."""
        return float(len(self.kept))

    def ranked(self, rank: int) -> float:
        """The sample that has `rank` smaller samples before it. Among equal samples, the earlier
        comes first.
        """
        values = [value for _, value in self.kept]
        if not values or any(value != value for value in values):
            return NAN
        return sorted(values)[rank]


class Recent:
    """The instants of the last few turning points or edges, counted within a window. `gap` is the
    value of their source when it was last unknown, and `gap_end_ns` the instant at which that
    ended, None while it lasts.
    """

    def __init__(self, count: int, window_ns: int) -> None:
        self.instants: deque[int] = deque(maxlen=count)
        self.window_ns = window_ns
        self.gap = 0
        self.gap_end_ns: int | None = 0

    def forget(self, at_ns: int) -> None:
        """Forget the past."""
        self.instants.clear()
        self.gap = 2
        self.gap_end_ns = at_ns

    def look(self, source: int, at_ns: int) -> int:
        """True if enough instants lie in the window; unknown if a gap may hide instants."""
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
        """True if the window contains the required number of instants."""
        return len(self.instants) == self.instants.maxlen

    def wake_ns(self, proposition: int, never_ns: int) -> int:
        """The instant at which the condition, whose value is `proposition`, may change by
        itself.
        """
        if proposition == 1:
            return self.instants[0] + self.window_ns
        if proposition < 2 or self.gap_end_ns is None:
            return never_ns
        return self.gap_end_ns + self.window_ns


class Recurrence:
    """The edges of a condition, and its value before."""

    def __init__(self, count: int, window_ns: int) -> None:
        self.recent = Recent(count, window_ns)
        self.before = 0

    def forget(self, at_ns: int) -> None:
        """Forget the past."""
        self.before = 2
        self.recent.forget(at_ns)

    def look(self, value: int, at_ns: int) -> int:
        """True if there were enough edges. `value` is the present value of the condition."""
        if value == 1 and self.before == 0:
            self.recent.instants.append(at_ns)
        self.before = value
        return self.recent.look(value, at_ns)


class Oscillation:
    """The turning points of a signal. `direction` is 1 upwards, -1 downwards, 0 unknown."""

    def __init__(self, count: int, window_ns: int, swing: float) -> None:
        self.recent = Recent(count, window_ns)
        self.swing = swing
        self.direction = 0
        self.extreme = NAN

    def forget(self, at_ns: int) -> None:
        """Forget the past."""
        self.clear()
        self.recent.forget(at_ns)

    def clear(self) -> None:
        """Forget the signal."""
        self.recent.instants.clear()
        self.direction = 0
        self.extreme = NAN

    def take(self, x: float, at_ns: int) -> None:
        """Take a finite sample."""
        going = self.direction
        if self.extreme != self.extreme or going * x > going * self.extreme:
            self.extreme = x
        elif going != 1 and x > self.extreme + self.swing:
            self.turn(1, x, at_ns)
        elif going != -1 and x < self.extreme - self.swing:
            self.turn(-1, x, at_ns)

    def turn(self, direction: int, x: float, at_ns: int) -> None:
        """Record a turning point: the signal now goes in this direction."""
        if self.direction != 0:
            self.recent.instants.append(at_ns)
        self.direction = direction
        self.extreme = x
