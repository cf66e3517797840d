"""Bars over time with names: active rules, and the states of skills."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from heron.demo.shots import Shot
from heron.tasks import Status, TreeSkill
from heron.variants import ExperimentArm

_LEAST = 0.15  # percent, so that what is over at once is seen
SIGNS = {Status.SUCCEEDED: "✓", Status.FAILED: "✗", Status.PREEMPTED: "–"}  # noqa: RUF001


@dataclass(frozen=True)
class Bar:
    """Something that was so for a while, in percent; `kind` is the class in the style sheet."""

    kind: str
    left: float
    width: float
    sign: str = ""


@dataclass(frozen=True)
class Row:
    """A name, so many levels deep, and its bars."""

    depth: int
    name: str
    bars: tuple[Bar, ...]


@dataclass(frozen=True)
class Lanes:
    """The rows of one kind for one arm."""

    arm: ExperimentArm
    rows: tuple[Row, ...]


def rules_of(shot: Shot, duration: float) -> Lanes:
    """The rules that became active, in the order of their first activation."""
    ordered = sorted(shot.rules.items(), key=lambda item: item[1][0])
    rows = [
        Row(0, rule, tuple(_bar("active", start, end, duration) for start, end in spans))
        for rule, spans in ordered
    ]
    return Lanes(shot.arm, tuple(rows))


def tree_of(shot: Shot, duration: float) -> Lanes:
    """The skills of the tree over time, with the final status of each skill."""
    rows = [
        Row(one.depth, one.label, tuple(_states(one, shot.duration, duration))) for one in shot.tree
    ]
    return Lanes(shot.arm, tuple(rows))


def _bar(kind: str, start: float, end: float, duration: float, sign: str = "") -> Bar:
    left, width = 100 * start / duration, 100 * (end - start) / duration
    return Bar(kind, round(left, 3), round(max(_LEAST, width), 3), sign)


def _states(skill: TreeSkill, over: float, duration: float) -> Iterator[Bar]:
    nexts = [span.start for span in skill.spans[1:]]
    for span, until in zip(skill.spans, [*nexts, over], strict=False):
        end = over if span.end is None else span.end
        yield _bar(Status.RUNNING.value, span.start, end, duration)
        if span.end is not None:
            yield _bar(span.status.value, span.end, until, duration, SIGNS[span.status])
