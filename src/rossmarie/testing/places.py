"""Candidates for thresholds in traces: the values that they were compared with, and the lengths of
time that durations were compared with.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from rossmarie import ir
from rossmarie.ir import TruthValue
from rossmarie.ir.support import compared_signals
from rossmarie.testing.goals import edges
from rossmarie.testing.history import History, backwards
from rossmarie.testing.margins import MovableThreshold


def compared_with_constants(machine: ir.Machine) -> tuple[int, ...]:
    """The signals that thresholds are compared with, and the other signals in these comparisons."""
    found: set[int] = set()
    for proposition in range(len(machine.propositions)):
        if edges(machine, proposition):
            node = machine.propositions[proposition].node
            leaf = (
                machine.propositions[node.element].node if isinstance(node, ir.Quantified) else node
            )
            found |= set(compared_signals(leaf))
    return tuple(
        sorted(each for each in found if not isinstance(machine.signals[each].node, ir.Constant))
    )


def seen_by(machine: ir.Machine, threshold: MovableThreshold, history: History) -> list[float]:
    """The values in SI, or the lengths in s, at which a threshold would change a result."""
    found: set[float] = set()
    for proposition in threshold.propositions:
        node = machine.propositions[proposition].node
        match node:
            case ir.Held(operand=operand):
                is_on = history.propositions[:, operand] == TruthValue.TRUE
                found |= set(_lengths(history, is_on))
            case ir.AgeReaches():
                found |= set(_ages(history, node))
            case (
                ir.Literal() | ir.Compare() | ir.Between() | ir.Flag() | ir.Oscillates()
                | ir.Quantified() | ir.Not() | ir.And() | ir.Or() | ir.Since() | ir.Recurs()
            ):  # fmt: skip
                for edge in edges(machine, proposition):
                    if edge.constant == threshold.constant:
                        found |= set(_values(history, edge.signal).tolist())
    return sorted(found)


def _values(history: History, signal: int) -> NDArray[np.float64]:
    values = history.signals.get(signal)
    if values is None:
        values = history.elements[signal].values
    return np.unique(values[np.isfinite(values)])


def _lengths(history: History, is_on: NDArray[np.bool_]) -> Iterator[float]:
    """The lengths in s of the stretches in which the flag is set. A jump of the clock ends a
    stretch.
    """
    begun: int | None = None
    rows = zip(
        history.at_ns.tolist(), is_on.tolist(), backwards(history.at_ns).tolist(), strict=True
    )
    last_ns = 0
    for at_ns, now_on, has_jumped in rows:
        if begun is not None and (has_jumped or not now_on):
            yield ((last_ns if has_jumped else at_ns) - begun) / 1e9
            begun = None
        if now_on and begun is None:
            begun = at_ns
        last_ns = at_ns
    if begun is not None:
        yield (last_ns - begun) / 1e9


def _ages(history: History, node: ir.AgeReaches) -> Iterator[float]:
    """The ages in s that the messages of an input reached, until the next message or the end."""
    ages_ns = history.ages_ns[node.input]
    gone_ns = np.maximum(np.diff(history.at_ns), 0)
    is_over = (ages_ns[1:] < ages_ns[:-1] + gone_ns) & (ages_ns[:-1] >= 0)
    yield from ((ages_ns[:-1] + gone_ns)[is_over] / 1e9).tolist()
    if len(ages_ns) and ages_ns[-1] >= 0:
        yield float(ages_ns[-1]) / 1e9
