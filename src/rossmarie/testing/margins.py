"""Margins of thresholds and durations: how far a threshold can move before the verdicts on traces
change.

A comparison changes only if its threshold passes an observed value, a duration only if it passes an
observed length. So there are finitely many candidates on each side.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache

from rossmarie import ir
from rossmarie.testing.goals import edges

NEAREST_PLACES = 64
"""The number of nearest candidates on each side that are tried one by one."""

Reported = tuple[int, int, int]
"""A verdict: rule, change, instant in nanoseconds."""

Verdicts = tuple[tuple[Reported, ...], ...]
"""For each trace, the verdicts of the rules that depend on the threshold, in the order of the
trace.
"""

Replay = Callable[[ir.Machine], Verdicts]


@dataclass(frozen=True)
class MovableThreshold:
    """A value that can be moved: the constant of a leaf, or the duration of a proposition.
    `constant` is a signal; a named constant moves wherever it is used. `propositions` are those
    that use the value.
    """

    propositions: tuple[int, ...]
    constant: int | None
    text: str
    value: float  # in SI; s for durations


@dataclass(frozen=True)
class ValueRange:
    """Two values in SI between which the result is unchanged; None means no limit."""

    low: float | None
    high: float | None


@dataclass(frozen=True)
class ThresholdMargin:
    """The margin of a threshold. Within `same`, every verdict is unchanged, to the instant. Within
    `as_often`, every rule becomes active and is cleared equally often, earlier or later.
    """

    threshold: MovableThreshold
    same: ValueRange
    as_often: ValueRange


def thresholds(machine: ir.Machine) -> Iterator[MovableThreshold]:
    """All thresholds and durations that rules depend on, in the order of the machine."""
    named: dict[int, list[int]] = {}
    reached = {
        proposition
        for rule in machine.rules
        for root in rule.roots
        for proposition in ir.reachable_propositions(machine, root)
    }
    wholes = {
        ir.held_of(machine, proposition): proposition
        for proposition in reached
        if ir.defined(machine, proposition)
    }
    for proposition in sorted(reached):
        found = machine.propositions[proposition]
        match found.node:
            case ir.Held(duration_ns=due_ns) | ir.AgeReaches(age_ns=due_ns):
                reported = machine.propositions[wholes.get(proposition, proposition)]
                text = f"the time of {' '.join(reported.text.split())}"
                yield MovableThreshold((proposition,), None, text, due_ns / 1e9)
            case (
                ir.Literal() | ir.Compare() | ir.Between() | ir.Flag() | ir.Oscillates()
                | ir.Quantified() | ir.Not() | ir.And() | ir.Or() | ir.Since() | ir.Recurs()
            ):  # fmt: skip
                pass
        for edge in edges(machine, proposition):
            shown = machine.signals[edge.constant]
            if shown.text.isidentifier():
                named.setdefault(edge.constant, []).append(proposition)
            else:
                text = f"{shown.text} in {' '.join(found.text.split())}"
                yield MovableThreshold((proposition,), edge.constant, text, edge.threshold)
    for constant, propositions in named.items():
        value = machine.signals[constant].node
        assert isinstance(value, ir.Constant)
        yield MovableThreshold(
            tuple(propositions), constant, machine.signals[constant].text, value.value
        )


def moved(machine: ir.Machine, threshold: MovableThreshold, value: float) -> ir.Machine:
    """The machine with a threshold moved to a value in SI."""
    if threshold.constant is None:
        (proposition,) = threshold.propositions
        return _replaced(
            machine, {proposition: _with_duration(machine.propositions[proposition].node, value)}
        )
    signal = dataclasses.replace(machine.signals[threshold.constant], node=ir.Constant(value))
    longer = dataclasses.replace(machine, signals=(*machine.signals, signal))
    nodes: dict[int, ir.PropositionNode] = {}
    for proposition in threshold.propositions:
        leaf = _leaf_of(machine, proposition)
        node = machine.propositions[leaf].node
        nodes[leaf] = _with_constant(node, threshold.constant, len(machine.signals))
    return _replaced(longer, nodes)


def _leaf_of(machine: ir.Machine, proposition: int) -> int:
    node = machine.propositions[proposition].node
    return node.element if isinstance(node, ir.Quantified) else proposition


def _replaced(machine: ir.Machine, nodes: Mapping[int, ir.PropositionNode]) -> ir.Machine:
    propositions = tuple(
        dataclasses.replace(proposition, node=nodes[index]) if index in nodes else proposition
        for index, proposition in enumerate(machine.propositions)
    )
    return dataclasses.replace(machine, propositions=propositions)


def _with_duration(node: ir.PropositionNode, value: float) -> ir.PropositionNode:
    length_ns = max(1, round(value * 1e9))
    if isinstance(node, ir.Held):
        return dataclasses.replace(node, duration_ns=length_ns)
    assert isinstance(node, ir.AgeReaches)
    return dataclasses.replace(node, age_ns=length_ns)


def _with_constant(node: ir.PropositionNode, old: int, new: int) -> ir.PropositionNode:
    def put(signal: int) -> int:
        return new if signal == old else signal

    if isinstance(node, ir.Compare):
        return dataclasses.replace(node, left=put(node.left), right=put(node.right))
    assert isinstance(node, ir.Between)
    return dataclasses.replace(node, low=put(node.low), high=put(node.high))


def margin(
    machine: ir.Machine, threshold: MovableThreshold, seen: Sequence[float], replay: Replay
) -> ThresholdMargin:
    """The margin of a threshold. `seen` are the observed values or lengths, the candidates."""
    usual = replay(machine)

    @cache
    def reported(value: float) -> Verdicts:
        return replay(moved(machine, threshold, value))

    def differs(value: float) -> bool:
        return reported(value) != usual

    def differs_in_number(value: float) -> bool:
        return _changes(reported(value)) != _changes(usual)

    ends = []
    for direction in (-1.0, 1.0):
        side = _Side(threshold, seen, direction)
        low = threshold.value if differs(side.next()) else side.first(differs)
        ends.append((low, side.first(differs_in_number)))
    (low, often_low), (high, often_high) = ends
    return ThresholdMargin(threshold, ValueRange(low, high), ValueRange(often_low, often_high))


def _changes(verdicts: Verdicts) -> list[list[tuple[int, int]]]:
    """The changes of each rule in each trace, without the instants."""
    return [
        sorted(((rule, change) for rule, change, _ in reported), key=lambda found: found[0])
        for reported in verdicts
    ]


class _Side:
    """The candidates on one side of a threshold, the nearest first."""

    def __init__(
        self, threshold: MovableThreshold, seen: Sequence[float], direction: float
    ) -> None:
        self._threshold = threshold
        self._direction = direction
        places = {each for each in seen if each * direction >= threshold.value * direction}
        self._places = sorted(places, reverse=direction < 0)

    def next(self) -> float:
        """The next value. A duration becomes a nanosecond longer or shorter, which moves its end. A
        comparison is unchanged until its threshold passes a candidate.
        """
        step = 1e-9 if self._threshold.constant is None else 0.0
        return self._threshold.value + self._direction * step

    def first(self, differs: Callable[[float], bool]) -> float | None:
        """The first candidate beyond which the result differs. The nearest candidates are tried one
        by one. Bisection finds the others; it assumes that the result differs from there on.
        """
        near = self._places[:NEAREST_PLACES]
        for index, place in enumerate(near):
            if differs(self._past(index)):
                return place
        low, high = len(near), len(self._places) - 1
        if high < low or not differs(self._past(high)):
            return None
        while low < high:
            middle = (low + high) // 2
            if differs(self._past(middle)):
                high = middle
            else:
                low = middle + 1
        return self._places[low]

    def _past(self, index: int) -> float:
        here = self._places[index]
        if index + 1 < len(self._places):
            return here + (self._places[index + 1] - here) / 2
        beyond = here + self._direction * max(abs(here), 1.0) / 1000
        return max(beyond, 0.0) if self._threshold.constant is None else beyond
