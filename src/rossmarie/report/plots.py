"""The signals of a machine that are plotted, with the limits that rules set for them.

The driver samples the signals that `plan_plots` names, and passes the samples to `PlotPlan.plot`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rossmarie import ir
from rossmarie.report.model import Plot, PlotThreshold

_ABOVE = (ir.Comparison.GREATER, ir.Comparison.GREATER_OR_EQUAL)
_BELOW = (ir.Comparison.LESS, ir.Comparison.LESS_OR_EQUAL)


@dataclass(frozen=True)
class PlotPlan:
    """A signal to sample: the driver records its value in SI units after every event."""

    signal: int
    text: str
    unit: str
    scale: float
    offset: float
    thresholds: tuple[PlotThreshold, ...]

    def plot(self, times_s: NDArray[np.float64], values_si: NDArray[np.float64]) -> Plot:
        """The plot of samples at ascending times on the axis of the replay."""
        values = values_si * self.scale + self.offset
        return Plot(self.text, self.unit, times_s, values, self.thresholds)


@dataclass(frozen=True)
class _Use:
    """A leaf that a rule depends on; `positive` unless the number of `not` in between is odd."""

    rule: str
    leaf: int
    name: str
    positive: bool
    releases: bool


def plan_plots(machine: ir.Machine) -> tuple[PlotPlan, ...]:
    """A plan for each number that a rule compares, in the order of the rules.

    Texts are left out, and so are signals with a value for each element of an array.
    """
    uses: dict[int, list[_Use]] = {}
    for use in _uses(machine):
        for signal in ir.compared_signals(machine.propositions[use.leaf].node):
            uses.setdefault(signal, []).append(use)
    elementwise = ir.element_arrays(machine).signals
    return tuple(
        _plan(machine, signal, found)
        for signal, found in uses.items()
        if elementwise[signal] is None and _is_number(machine, signal)
    )


def _is_number(machine: ir.Machine, signal: int) -> bool:
    match machine.signals[signal].node:
        case ir.Constant():
            return False
        case ir.Read(slot=slot):
            return machine.slots[slot].kind is not ir.FieldKind.TEXT
        case ir.Apply() | ir.Sampled() | ir.Element() | ir.Fold() | ir.Count():
            return True


def _uses(machine: ir.Machine) -> Iterator[_Use]:
    for rule in machine.rules:
        yield from _below(machine, rule.name, rule.condition, releases=False)
        if rule.release is not None:
            yield from _below(machine, rule.name, rule.release, releases=True)


def _below(machine: ir.Machine, rule: str, top: int, *, releases: bool) -> Iterator[_Use]:
    waiting: list[tuple[int, str, bool]] = [(top, "", True)]
    seen: set[tuple[int, bool]] = set()
    while waiting:
        index, name, positive = waiting.pop()
        proposition = machine.propositions[index]
        if (index, positive) in seen:
            continue
        seen.add((index, positive))
        name = proposition.name or name
        if ir.is_leaf(proposition.node):
            yield _Use(rule, index, name, positive, releases)
            continue
        whole = ir.defined(machine, index)
        inner = positive != (whole is None and isinstance(proposition.node, ir.Not))
        operands = ir.proposition_operands(proposition.node) if whole is None else whole.operands
        waiting.extend((operand, name, inner) for operand in reversed(operands))


def _plan(machine: ir.Machine, index: int, uses: list[_Use]) -> PlotPlan:
    signal = machine.signals[index]
    grouped: dict[tuple[int, str, bool, bool], list[str]] = {}
    for use in uses:
        rules = grouped.setdefault((use.leaf, use.name, use.positive, use.releases), [])
        if use.rule not in rules:
            rules.append(use.rule)
    found = []
    for (leaf, name, positive, releases), rules in grouped.items():
        shape = _shape(machine, machine.propositions[leaf].node, index)
        if shape is not None:
            text = name or machine.propositions[leaf].text
            limits = tuple(limit * signal.scale + signal.offset for limit in shape)
            regions = _regions(machine.propositions[leaf].node, index, limits, positive)
            found.append(PlotThreshold(limits, regions, text, tuple(rules), releases))
    return PlotPlan(
        index, signal.text, signal.unit, signal.scale, signal.offset, _drawn_once(found)
    )


def _drawn_once(found: list[PlotThreshold]) -> tuple[PlotThreshold, ...]:
    """The thresholds, except a release that is only the negation of the condition."""
    limits = {threshold.limits for threshold in found if not threshold.releases}
    return tuple(
        threshold for threshold in found if not (threshold.releases and threshold.limits in limits)
    )


def _shape(machine: ir.Machine, node: ir.PropositionNode, signal: int) -> tuple[float, ...] | None:
    """The constants (SI) that a leaf compares the signal with; None if they are not constant."""
    others: tuple[int, ...]
    match node:
        case ir.Compare(left=left, right=right):
            others = (right,) if left == signal else (left,)
        case ir.Between(signal=compared, low=low, high=high) if compared == signal:
            others = (low, high)
        case (
            ir.Literal() | ir.Between() | ir.Flag() | ir.AgeReaches() | ir.Oscillates()
            | ir.Quantified() | ir.Not() | ir.And() | ir.Or() | ir.Held() | ir.Since() | ir.Recurs()
        ):  # fmt: skip
            return None
    nodes = [machine.signals[other].node for other in others]
    values = tuple(node.value for node in nodes if isinstance(node, ir.Constant))
    return values if len(values) == len(nodes) else None


def _regions(
    node: ir.PropositionNode, signal: int, limits: tuple[float, ...], positive: bool
) -> tuple[tuple[float, float], ...]:
    if isinstance(node, ir.Between):
        low, high = limits
        return ((low, high),) if positive else ((-math.inf, low), (high, math.inf))
    if not isinstance(node, ir.Compare) or node.comparison not in (*_ABOVE, *_BELOW):
        return ()
    above = (node.comparison in _ABOVE) == (node.left == signal)
    if above == positive:
        return ((limits[0], math.inf),)
    return ((-math.inf, limits[0]),)
