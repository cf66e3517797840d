"""Margins of thresholds and durations: how far one can move before what the rules say of traces
changes.

A comparison changes only where its threshold passes a value that was seen, a duration only where
it passes a length that was seen. So there are finitely many places to look at, on each side of it.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache

from rossmarie import ir
from rossmarie.testing.goals import edges

NEAREST_PLACES = 64
"""On each side of a threshold so many places are tried one by one."""

Told = tuple[int, int, int]
"""A verdict: rule, change, instant in nanoseconds."""

Verdicts = tuple[tuple[Told, ...], ...]
"""Of each trace what the rules that rest on the threshold say, in the order of the trace."""

Replay = Callable[[ir.Machine], Verdicts]


@dataclass(frozen=True)
class Threshold:
    """Something that can be moved: the constant of one leaf (`constant` is a signal; a named one
    moves wherever it stands), or the duration of a truth. `truths` are those that it belongs to.
    """

    truths: tuple[int, ...]
    constant: int | None
    text: str
    value: float  # SI; seconds for durations


@dataclass(frozen=True)
class Reach:
    """Two values in SI between which something stays as it is; None: it does so all the way."""

    low: float | None
    high: float | None


@dataclass(frozen=True)
class Margin:
    """The margin of a threshold. Within `same`, every verdict stays as it is, to the instant;
    within `as_often`, every rule becomes active and is cleared as often, earlier or later.
    """

    threshold: Threshold
    same: Reach
    as_often: Reach


def thresholds(machine: ir.Machine) -> Iterator[Threshold]:
    """All thresholds and durations that rules rest on, in the order of the machine."""
    named: dict[int, list[int]] = {}
    reached = {
        truth
        for rule in machine.rules
        for root in rule.roots
        for truth in ir.reachable_truths(machine, root)
    }
    wholes = {ir.held_of(machine, truth): truth for truth in reached if ir.defined(machine, truth)}
    for truth in sorted(reached):
        found = machine.truths[truth]
        match found.node:
            case ir.Held(duration_ns=due_ns) | ir.AgeReaches(age_ns=due_ns):
                told = machine.truths[wholes.get(truth, truth)]
                text = f"the time of {' '.join(told.text.split())}"
                yield Threshold((truth,), None, text, due_ns / 1e9)
            case (
                ir.Literal() | ir.Compare() | ir.Between() | ir.Flag() | ir.Oscillates()
                | ir.Quantified() | ir.Not() | ir.And() | ir.Or() | ir.Since() | ir.Recurs()
            ):  # fmt: skip
                pass
        for edge in edges(machine, truth):
            shown = machine.signals[edge.constant]
            if shown.text.isidentifier():
                named.setdefault(edge.constant, []).append(truth)
            else:
                text = f"{shown.text} in {' '.join(found.text.split())}"
                yield Threshold((truth,), edge.constant, text, edge.threshold)
    for constant, truths in named.items():
        value = machine.signals[constant].node
        assert isinstance(value, ir.Constant)
        yield Threshold(tuple(truths), constant, machine.signals[constant].text, value.value)


def moved(machine: ir.Machine, threshold: Threshold, value: float) -> ir.Machine:
    """The machine with a threshold moved to a value in SI."""
    if threshold.constant is None:
        (truth,) = threshold.truths
        return _replaced(machine, {truth: _with_duration(machine.truths[truth].node, value)})
    signal = dataclasses.replace(machine.signals[threshold.constant], node=ir.Constant(value))
    longer = dataclasses.replace(machine, signals=(*machine.signals, signal))
    nodes: dict[int, ir.TruthNode] = {}
    for truth in threshold.truths:
        leaf = _leaf_of(machine, truth)
        node = machine.truths[leaf].node
        nodes[leaf] = _with_constant(node, threshold.constant, len(machine.signals))
    return _replaced(longer, nodes)


def _leaf_of(machine: ir.Machine, truth: int) -> int:
    node = machine.truths[truth].node
    return node.element if isinstance(node, ir.Quantified) else truth


def _replaced(machine: ir.Machine, nodes: Mapping[int, ir.TruthNode]) -> ir.Machine:
    truths = tuple(
        dataclasses.replace(truth, node=nodes[index]) if index in nodes else truth
        for index, truth in enumerate(machine.truths)
    )
    return dataclasses.replace(machine, truths=truths)


def _with_duration(node: ir.TruthNode, value: float) -> ir.TruthNode:
    length_ns = max(1, round(value * 1e9))
    if isinstance(node, ir.Held):
        return dataclasses.replace(node, duration_ns=length_ns)
    assert isinstance(node, ir.AgeReaches)
    return dataclasses.replace(node, age_ns=length_ns)


def _with_constant(node: ir.TruthNode, old: int, new: int) -> ir.TruthNode:
    def put(signal: int) -> int:
        return new if signal == old else signal

    if isinstance(node, ir.Compare):
        return dataclasses.replace(node, left=put(node.left), right=put(node.right))
    assert isinstance(node, ir.Between)
    return dataclasses.replace(node, low=put(node.low), high=put(node.high))


def margin(
    machine: ir.Machine, threshold: Threshold, seen: Sequence[float], replay: Replay
) -> Margin:
    """The margin of a threshold; `seen` are the values, or lengths, that it could pass."""
    usual = replay(machine)

    @cache
    def told(value: float) -> Verdicts:
        return replay(moved(machine, threshold, value))

    def differs(value: float) -> bool:
        return told(value) != usual

    def differs_in_number(value: float) -> bool:
        return _changes(told(value)) != _changes(usual)

    ends = []
    for way in (-1.0, 1.0):
        side = _Side(threshold, seen, way)
        low = threshold.value if differs(side.next()) else side.first(differs)
        ends.append((low, side.first(differs_in_number)))
    (low, often_low), (high, often_high) = ends
    return Margin(threshold, Reach(low, high), Reach(often_low, often_high))


def _changes(verdicts: Verdicts) -> list[list[tuple[int, int]]]:
    """The changes of each rule in each trace, without the instants."""
    return [
        sorted(((rule, change) for rule, change, _ in told), key=lambda found: found[0])
        for told in verdicts
    ]


class _Side:
    """The places on one side of a threshold, from the nearest on."""

    def __init__(self, threshold: Threshold, seen: Sequence[float], way: float) -> None:
        self._threshold = threshold
        self._way = way
        places = {each for each in seen if each * way >= threshold.value * way}
        self._places = sorted(places, reverse=way < 0)

    def next(self) -> float:
        """A duration that is a nanosecond longer or shorter: with it, whatever waits for it comes
        at another instant. A comparison is as it was until its threshold passes a place.
        """
        step = 1e-9 if self._threshold.constant is None else 0.0
        return self._threshold.value + self._way * step

    def first(self, differs: Callable[[float], bool]) -> float | None:
        """The first place past which something differs: the nearest ones are tried one by one;
        of the others it is found by bisection, as if what differs did so from there on.
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
        beyond = here + self._way * max(abs(here), 1.0) / 1000
        return max(beyond, 0.0) if self._threshold.constant is None else beyond
