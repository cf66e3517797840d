"""Round numbers and durations."""

from __future__ import annotations

import math

from rossmarie.recordings.model import Rhythm

FEWEST = 5
"""The least number of messages from which a rhythm can be computed."""
SHORTEST_S = 0.05
"""The shortest timeout in seconds: an operating system without real time may pause for this
long.
"""
PERIODS = 3
MOST_PERIODS = 5
GAPS = 1.5
_MOST_OUTLIERS = 0.02
_STEPS = (1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10)
_EXACT = 1e-9


def rounded_up(number: float) -> float:
    """A number at or above a positive number: 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6 or 8 times a power of
    ten.
    """
    power = 10.0 ** math.floor(math.log10(number))
    step = next(each for each in _STEPS if each * power >= number * (1 - _EXACT))
    return float(f"{step * power:.3g}")


def rounded_down(number: float) -> float:
    """Such a number at or below a positive number."""
    power = 10.0 ** math.floor(math.log10(number))
    step = next(each for each in reversed(_STEPS) if each * power <= number * (1 + _EXACT))
    return float(f"{step * power:.3g}")


def plain(number: float) -> str:
    """A number without an exponent, if this form is short: `0.05`, `12`."""
    return f"{number:.3g}" if 1e-3 <= abs(number) < 1e3 else f"{number:.6g}"


def is_steady(rhythm: Rhythm) -> bool:
    """Say whether messages arrive so regularly that silence has a meaning."""
    if rhythm.count < FEWEST or rhythm.median_ns <= 0:
        return False
    return rhythm.outliers <= _MOST_OUTLIERS


def timeout_s(rhythm: Rhythm) -> float:
    """The timeout in s for a topic with this rhythm.

    It is three periods, or one and a half times the longest gap, whichever is longer. For a steady
    topic it is at most five periods, so that a pause of the sensor in the recording is detected.
    """
    period, longest = rhythm.median_ns / 1e9, rhythm.longest_ns / 1e9
    wanted = max(PERIODS * period, GAPS * longest, SHORTEST_S)
    if is_steady(rhythm):
        wanted = min(wanted, max(MOST_PERIODS * period, SHORTEST_S))
    return rounded_up(wanted)
