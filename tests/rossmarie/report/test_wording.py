from __future__ import annotations

import pytest

from rossmarie.report.wording import format_length, format_position

SECOND = 1_000_000_000


@pytest.mark.parametrize(
    ("position", "text"),
    [
        (0, "00:00.0"),
        (12.34, "00:12.3"),
        (59.96, "01:00.0"),
        (395, "06:35.0"),
        (3600 + 61.5, "1:01:01.5"),
    ],
)
def test_positions(position: float, text: str) -> None:
    assert format_position(round(position * SECOND)) == text


@pytest.mark.parametrize(
    ("length", "text"),
    [
        (0, "0 s"),
        (0.0331, "0.033 s"),
        (1e-9, "0.001 s"),
        (0.999, "1.0 s"),
        (12.34, "12.3 s"),
        (59.97, "1 min 00 s"),
        (125.2, "2 min 05 s"),
        (7800, "2 h 10 min"),
        (3 * 86400 + 14400, "3 d 4 h"),
    ],
)
def test_lengths(length: float, text: str) -> None:
    assert format_length(round(length * SECOND)) == text
