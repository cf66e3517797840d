"""Signals and rules over time as SVG: all charts of an experiment have one time axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from heron.demo.shots import Curve, Shot
from heron.experiments.table import Signal
from heron.variants import Arm

WIDTH, LEFT, RIGHT = 1000, 64, 12
_HEIGHT, _TOP = 104, 8
_ROW = 22
_GAP, _LETTER = 8, 7.3
Text = tuple[float, float, str]


@dataclass(frozen=True)
class Line:
    """A curve as SVG has it."""

    arm: Arm
    points: str


@dataclass(frozen=True)
class Chart:
    """A signal in all arms. Positions are in the coordinates of the drawing."""

    label: str
    height: int
    lines: tuple[Line, ...]
    limit: float | None
    marks: tuple[Text, ...]


@dataclass(frozen=True)
class Row:
    """A rule: its bars as x and width, and where its name stands, from there or up to there."""

    y: float
    rule: str
    bars: tuple[tuple[float, float], ...]
    name_x: float
    is_name_before: bool


@dataclass(frozen=True)
class Strip:
    """The rules that were active."""

    height: int
    rows: tuple[Row, ...]


def x_of(time: float, duration: float) -> float:
    """Where an instant is drawn."""
    return round(LEFT + (WIDTH - LEFT - RIGHT) * time / duration, 1)


def chart_of(signal: Signal, shots: Sequence[Shot], duration: float) -> Chart:
    """One signal of all shots."""
    curves = {shot.arm: shot.curves[signal.label] for shot in shots}
    values = [value for curve in curves.values() for _, value in curve]
    if signal.limit is not None:
        values += [signal.limit, 0.0]
    low, high = min(values), max(values)
    span = (high - low) or 1.0

    def y_of(value: float) -> float:
        return round(_TOP + (_HEIGHT - 2 * _TOP) * (high - value) / span, 1)

    return Chart(
        label=f"{signal.label} ({signal.unit})",
        height=_HEIGHT,
        lines=tuple(Line(arm, _points(curve, duration, y_of)) for arm, curve in curves.items()),
        limit=None if signal.limit is None else y_of(signal.limit),
        marks=tuple((LEFT - 6.0, y_of(value) + 4, _number(value)) for value in (low, high)),
    )


def _number(value: float) -> str:
    return f"{value:.0f}" if abs(value) >= 10 else f"{round(value, 1) + 0.0:.1f}"


def _points(curve: Curve, duration: float, y_of: object) -> str:
    assert callable(y_of)
    return " ".join(f"{x_of(time, duration)},{y_of(value)}" for time, value in curve)


def strip_of(shots: Sequence[Shot], duration: float) -> Strip:
    """The rules of all shots."""
    spans = {rule: found for shot in shots for rule, found in shot.rules.items()}
    ordered = sorted(spans.items(), key=lambda item: item[1][0])
    rows = [_row(place * _ROW, *item, duration) for place, item in enumerate(ordered)]
    return Strip(_ROW * len(rows), tuple(rows))


def _row(y: float, rule: str, spans: Sequence[tuple[float, float]], duration: float) -> Row:
    """The name stands behind the bars, or before them where there is no room."""
    ends = [(x_of(start, duration), x_of(end, duration)) for start, end in spans]
    bars = tuple((start, max(1.5, end - start)) for start, end in ends)
    first, last = ends[0][0], ends[-1][1]
    is_before = last + _GAP + _LETTER * len(rule) > WIDTH
    return Row(y, rule, bars, first - _GAP if is_before else last + _GAP, is_before)


def ticks(duration: float) -> tuple[Text, ...]:
    """The time axis: a mark every 1, 2, 5, 10... seconds, about ten of them."""
    step = next(step for step in (1, 2, 5, 10, 20, 50, 100) if duration / step <= 12)
    return tuple(
        (x_of(time, duration), 14.0, f"{time} s") for time in range(0, int(duration) + 1, step)
    )
