"""Signals over time as SVG: all charts of an experiment have one time axis."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from heron.demo.shots import Curve, Shot
from heron.experiments.table import Signal
from heron.variants import Arm

WIDTH, RIGHT = 1000, 12
_HEIGHT, _TOP = 104, 8
Text = tuple[float, float, str]


@dataclass(frozen=True)
class Axis:
    """Time, from `left` on, where names end, up to so many seconds."""

    left: float
    duration: float

    def x_of(self, time: float) -> float:
        """Where an instant is drawn."""
        return round(self.left + (WIDTH - self.left - RIGHT) * time / self.duration, 1)

    def ticks(self) -> tuple[Text, ...]:
        """A mark every 1, 2, 5, 10... seconds, about ten of them."""
        step = next(step for step in (1, 2, 5, 10, 20, 50, 100) if self.duration / step <= 12)
        times = range(0, int(self.duration) + 1, step)
        return tuple((self.x_of(time), 14.0, f"{time} s") for time in times)


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
    limit_text: str
    marks: tuple[Text, ...]


def chart_of(signal: Signal, shots: Sequence[Shot], axis: Axis) -> Chart:
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
        lines=tuple(Line(arm, _points(curve, axis, y_of)) for arm, curve in curves.items()),
        limit=None if signal.limit is None else y_of(signal.limit),
        limit_text="" if signal.limit is None else f"{signal.limit:g} {signal.unit}",
        marks=tuple((axis.left - 6.0, y_of(value) + 4, _number(value)) for value in (low, high)),
    )


def _number(value: float) -> str:
    return f"{value:.0f}" if abs(value) >= 10 else f"{round(value, 1) + 0.0:.1f}"


def _points(curve: Curve, axis: Axis, y_of: Callable[[float], float]) -> str:
    return " ".join(f"{axis.x_of(time)},{y_of(value)}" for time, value in curve)
