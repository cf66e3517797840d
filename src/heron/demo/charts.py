"""Charts of signals over time. All charts of an experiment have the same time axis.

A chart is drawn in a plane of width 1000 and height 100, and scaled to its place on the page. Text
stands beside the chart, in percent of its sides.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.ticker import MaxNLocator

from heron.demo.shots import Curve, Shot
from heron.experiments.experiment import TraceSignal
from heron.variants import ExperimentArm

WIDTH, HEIGHT = 1000, 100
_STEPS = (1, 2, 5, 10)
_HEADROOM = 0.04  # of the span, above and below


@dataclass(frozen=True)
class Tick:
    """A line of the grid, at so many percent of the width or the height."""

    at: float
    text: str


@dataclass(frozen=True)
class Line:
    """A curve as SVG has it."""

    arm: ExperimentArm
    points: str


@dataclass(frozen=True)
class Chart:
    """A signal in all arms, from `low` to `high`. `limit` is in percent of the height."""

    label: str
    unit: str
    digits: int
    low: float
    high: float
    lines: tuple[Line, ...]
    limit: Tick | None
    ticks: tuple[Tick, ...]


def time_ticks(duration: float) -> tuple[Tick, ...]:
    """A mark every 1, 2, 5, 10... seconds."""
    return tuple(
        Tick(round(100 * time / duration, 3), f"{time:g} s")
        for time in MaxNLocator(8, steps=_STEPS).tick_values(0.0, duration)
        if 0.0 <= time <= duration
    )


def chart_of(signal: TraceSignal, shots: Sequence[Shot], duration: float) -> Chart:
    """One signal of all shots."""
    curves = {shot.arm: shot.curves[signal.label] for shot in shots}
    values = [value for curve in curves.values() for _, value in curve]
    if signal.limit is not None:
        values += [signal.limit, 0.0]
    span = (max(values) - min(values)) or 1.0
    low, high = min(values) - _HEADROOM * span, max(values) + _HEADROOM * span

    def tick(value: float, text: str) -> Tick:
        return Tick(round(100 * (high - value) / (high - low), 2), text)

    def points(curve: Curve) -> str:
        return " ".join(
            f"{round(WIDTH * time / duration, 2):g},"
            f"{round(HEIGHT * (high - value) / (high - low), 2):g}"
            for time, value in curve
        )

    return Chart(
        label=signal.label,
        unit=signal.unit,
        digits=2 if span < 2 else 1,
        low=low,
        high=high,
        lines=tuple(Line(arm, points(curve)) for arm, curve in curves.items()),
        limit=None
        if signal.limit is None
        else tick(signal.limit, f"{signal.limit:g} {signal.unit}"),
        ticks=tuple(
            tick(value, f"{value:g}")
            for value in MaxNLocator(4, steps=_STEPS).tick_values(low, high)
            if low <= value <= high
        ),
    )
