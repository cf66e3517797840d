"""Bars over time as SVG, with names before them: active rules, and what skills are at."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from heron.demo.charts import Axis
from heron.demo.shots import Shot
from heron.tasks import Status, TreeSkill
from heron.variants import Arm

_ROW = 18
_INDENT = 14.0
_LETTER, _GAP = 7.3, 10.0
_NARROWEST = 64.0
_LEAST = 1.5  # so that what is over at once is seen
SIGNS = {Status.SUCCEEDED: "✓", Status.FAILED: "✗", Status.PREEMPTED: "–"}  # noqa: RUF001


@dataclass(frozen=True)
class Bar:
    """Something that was so for a while; `kind` is the class in the style sheet."""

    kind: str
    x: float
    width: float
    sign: str = ""


@dataclass(frozen=True)
class Row:
    """A name, indented by `x`, and its bars."""

    y: int
    x: float
    name: str
    bars: tuple[Bar, ...]


@dataclass(frozen=True)
class Lanes:
    """What an arm has to show of one kind."""

    arm: Arm
    height: int
    rows: tuple[Row, ...]


def axis_of(shots: Sequence[Shot]) -> Axis:
    """The axis that leaves room for all names."""
    widths = [_LETTER * len(rule) for shot in shots for rule in shot.rules]
    widths += [
        _INDENT * one.depth + _LETTER * len(one.label) for shot in shots for one in shot.tree
    ]
    left = max([_NARROWEST, *(width + _GAP for width in widths)])
    return Axis(round(left), max(shot.duration for shot in shots))


def rules_of(shot: Shot, axis: Axis) -> Lanes:
    """The rules that were active, in the order in which they became so."""
    ordered = sorted(shot.rules.items(), key=lambda item: item[1][0])
    named = [
        (0, rule, [_bar("active", start, end, axis) for start, end in spans])
        for rule, spans in ordered
    ]
    return _lanes(shot.arm, named)


def tree_of(shot: Shot, axis: Axis) -> Lanes:
    """The skills of the tree: how each ran, and what it stands at from then on."""
    named = [(one.depth, one.label, [*_states(one, shot.duration, axis)]) for one in shot.tree]
    return _lanes(shot.arm, named)


def _lanes(arm: Arm, named: Sequence[tuple[int, str, Sequence[Bar]]]) -> Lanes:
    rows = [
        Row(place * _ROW, depth * _INDENT, name, tuple(bars))
        for place, (depth, name, bars) in enumerate(named)
    ]
    return Lanes(arm, _ROW * len(rows), tuple(rows))


def _bar(kind: str, start: float, end: float, axis: Axis, sign: str = "") -> Bar:
    x = axis.x_of(start)
    return Bar(kind, x, round(max(_LEAST, axis.x_of(end) - x), 1), sign)


def _states(skill: TreeSkill, over: float, axis: Axis) -> Iterator[Bar]:
    nexts = [span.start for span in skill.spans[1:]]
    for span, until in zip(skill.spans, [*nexts, over], strict=False):
        end = over if span.end is None else span.end
        yield _bar(Status.RUNNING.value, span.start, end, axis)
        if span.end is not None:
            yield _bar(span.status.value, span.end, until, axis, SIGNS[span.status])


def running_of(tree: Sequence[TreeSkill], over: float) -> list[tuple[str, float, float]]:
    """What has nothing below it: its name, and from when to when it ran."""
    below = [one.depth for one in tree[1:]]
    leaves = [one for one, depth in zip(tree, [*below, 0], strict=True) if depth <= one.depth]
    return [
        (one.label, span.start, over if span.end is None else span.end)
        for one in leaves
        for span in one.spans
    ]
