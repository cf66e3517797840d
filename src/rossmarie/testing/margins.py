"""How far a threshold or a duration could be moved before what the rules say of traces changes.

A comparison changes only where its threshold passes a value that was seen, a duration only where
it passes a length that was seen. So there are finitely many places to look at: they are tried by
bisection, which takes for granted that a change is not undone by moving further.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rossmarie import ir
from rossmarie.testing.goals import edges

NEAREST_PLACES = 256
"""On each side of a threshold the nearest values that were seen are places to look at, and as many
of the others, evenly; so ten replays or less settle one side.
"""

Verdicts = tuple[tuple[tuple[int, int], ...], ...]
"""Of each trace the changes of each rule: rule and change, in order."""

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
class Margin:
    """The nearest values, in SI, beyond which verdicts change; None: none of those that were seen
    makes a difference.
    """

    threshold: Threshold
    low: float | None
    high: float | None


def thresholds(machine: ir.Machine) -> Iterator[Threshold]:
    """All thresholds and durations that rules rest on, in the order of the machine."""
    named: dict[int, list[int]] = {}
    reached = {
        truth
        for rule in machine.rules
        for root in (rule.condition, rule.release)
        if root is not None
        for truth in ir.reachable_truths(machine, root)
    }
    for truth in sorted(reached):
        found = machine.truths[truth]
        match found.node:
            case ir.Held(duration_ns=due_ns) | ir.AgeReaches(age_ns=due_ns):
                text = f"the time of {' '.join(found.text.split())}"
                yield Threshold((truth,), None, text, due_ns / 1e9)
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
    machine: ir.Machine,
    threshold: Threshold,
    seen: Sequence[float],
    replay: Replay,
    usual: Verdicts,
) -> Margin:
    """How far a threshold can go; `seen` are the values, or lengths, that it could pass, `usual` is
    what the machine says as it is.
    """

    def differs(value: float) -> bool:
        return replay(moved(machine, threshold, value)) != usual

    above = _thinned(sorted({each for each in seen if each >= threshold.value}))
    below = _thinned(sorted({each for each in seen if each <= threshold.value}, reverse=True))
    lowest = 0.0 if threshold.constant is None else None
    low = _first(below, differs, -1.0, lowest)
    return Margin(threshold, low, _first(above, differs, 1.0, None))


def _thinned(places: Sequence[float]) -> Sequence[float]:
    """The nearest places, and the last one, and some in between."""
    near, far = places[:NEAREST_PLACES], places[NEAREST_PLACES:]
    step = -(-len(far) // NEAREST_PLACES) or 1
    return [*near, *far[::-1][::step][::-1]]


def _first(
    places: Sequence[float], differs: Callable[[float], bool], way: float, limit: float | None
) -> float | None:
    """The first of the places, from the nearest on, past which something differs."""

    def past(index: int) -> float:
        here = places[index]
        if index + 1 < len(places):
            return here + (places[index + 1] - here) / 2
        beyond = here + way * max(abs(here), 1.0) / 1000
        return beyond if limit is None else max(beyond, limit)

    if not places or not differs(past(len(places) - 1)):
        return None
    low, high = 0, len(places) - 1
    while low < high:
        middle = (low + high) // 2
        if differs(past(middle)):
            high = middle
        else:
            low = middle + 1
    return places[low]
