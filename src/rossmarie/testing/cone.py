"""The cone of a threshold: the part of a machine that depends on the threshold, run separately.

A moved threshold leaves most of a machine unchanged. The changed part consists of the propositions
that depend on the threshold, and the rules that depend on these. It is a machine of its own. Its
inputs are the propositions at its boundary: they keep their old values, except for the moved
comparisons, which are computed again. It runs only at the few instants at which one of its inputs
changes. Its verdicts equal the verdicts of the whole machine.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rossmarie import ir
from rossmarie.analysis.part import moved_proposition
from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, TruthValue
from rossmarie.ir.comparison import COMPARISONS
from rossmarie.ir.support import compared_signals, proposition_operands
from rossmarie.testing.history import ElementHistory, History, backwards
from rossmarie.testing.margins import Reported

_NEVER_NS = 2 * ir.LATEST_NS
# A proposition is fed in as two flags. One of them is missing if the proposition is unknown. A
# missing flag whose input may be stale makes the proposition stale.
_FLAGS = {
    TruthValue.FALSE: (0.0, 0.0),
    TruthValue.TRUE: (1.0, 0.0),
    TruthValue.UNKNOWN: (math.nan, 0.0),
    TruthValue.STALE: (0.0, math.nan),
}


@dataclass(frozen=True)
class Cone:
    """The part of a machine that depends on moved propositions, with indices of the whole machine:
    the propositions `inside`, the `rules`, and the `boundary`, which are the inputs.
    """

    moved: tuple[int, ...]
    boundary: tuple[int, ...]
    inside: tuple[int, ...]
    rules: tuple[int, ...]


def cone_of(machine: ir.Machine, moved: Sequence[int]) -> Cone | None:
    """The cone of propositions with moved thresholds or durations. None if the cone cannot be
    separated: its elements are counted, or several conditions use them.
    """
    if not all(_is_apart(machine, proposition, moved) for proposition in moved):
        return None
    held = {
        proposition
        for proposition in moved
        if isinstance(machine.propositions[proposition].node, ir.Held)
    }
    inside: set[int] = set(held)
    for index, proposition in enumerate(machine.propositions):
        if (inside | set(moved)) & set(proposition_operands(proposition.node)):
            inside.add(index)
    rules = tuple(
        index for index, rule in enumerate(machine.rules) if set(rule.roots) & (inside | set(moved))
    )
    wanted = {
        each
        for proposition in inside
        for each in proposition_operands(machine.propositions[proposition].node)
    }
    wanted |= {root for index in rules for root in machine.rules[index].roots}
    boundary = tuple(sorted(wanted - inside))
    return Cone(tuple(moved), boundary, tuple(sorted(inside)), rules)


def _is_apart(machine: ir.Machine, proposition: int, moved: Sequence[int]) -> bool:
    node = machine.propositions[proposition].node
    match node:
        case ir.Held() | ir.AgeReaches() | ir.Compare() | ir.Between():
            return True
        case ir.Quantified():
            return _is_alone(machine, node, moved)
        case (
            ir.Literal() | ir.Flag() | ir.Oscillates() | ir.Not() | ir.And() | ir.Or()
            | ir.Since() | ir.Recurs()
        ):  # fmt: skip
            return False


def _is_alone(machine: ir.Machine, node: ir.Quantified, moved: Sequence[int]) -> bool:
    """Say whether only moved propositions depend on a quantified proposition, and its elements are
    used without other numbers. The history does not contain such numbers.
    """
    if ir.element_arrays(machine).propositions[node.element] in ir.beside(machine):
        return False
    counted = {each.node.element for each in machine.signals if isinstance(each.node, ir.Count)}
    users = {
        index
        for index, each in enumerate(machine.propositions)
        if node.element in proposition_operands(each.node)
        or (isinstance(each.node, ir.Quantified) and each.node.element == node.element)
    }
    return node.element not in counted and users <= set(moved)


# --- the machine -----------------------------------------------------------------------------


def _residual(cone: Cone, machine: ir.Machine) -> ir.Machine:
    """The machine of a cone: a channel with two flags for each proposition of the boundary, and the
    nodes that depend on these.
    """
    boundary, inside = cone.boundary, cone.inside
    span = machine.propositions[boundary[0]].span
    flags = range(2 * len(boundary))
    places = {proposition: 3 * number + 2 for number, proposition in enumerate(boundary)}
    places |= {proposition: 3 * len(boundary) + number for number, proposition in enumerate(inside)}
    propositions: list[ir.Proposition] = []
    for number, proposition in enumerate(boundary):
        known, stale = 2 * number, 2 * number + 1
        pair = (len(propositions), len(propositions) + 1)
        nodes = (ir.Flag(known), ir.Flag(stale), ir.Or(pair))
        propositions += [
            dataclasses.replace(machine.propositions[proposition], node=node) for node in nodes
        ]
    propositions += [
        dataclasses.replace(found, node=moved_proposition(found.node, {}, places))
        for found in (machine.propositions[proposition] for proposition in inside)
    ]
    return dataclasses.replace(
        machine,
        channels=(ir.Channel("/propositions", ""),),
        inputs=(ir.Input("known", 0, None, span), ir.Input("stale", 0, _NEVER_NS, span)),
        slots=tuple(ir.Slot(flag % 2, (), ir.FieldKind.FLAG, 1.0, 0.0, "") for flag in flags),
        arrays=(),
        signals=tuple(ir.Signal(ir.Read(flag), "", "", 1.0, 0.0, span) for flag in flags),
        propositions=tuple(propositions),
        rules=tuple(_placed_rule(machine.rules[index], places) for index in cone.rules),
        watches=(),
        readings=(),
        reactions=ir.NO_REACTIONS,
    )


def _placed_rule(rule: ir.Rule, places: dict[int, int]) -> ir.Rule:
    release = None if rule.release is None else places[rule.release]
    condition = places[rule.condition]
    return dataclasses.replace(
        rule, condition=condition, release=release, terms=(), signals=(), inputs=()
    )


# --- a run -----------------------------------------------------------------------------------


def reported_by(cone: Cone, moved: ir.Machine, history: History) -> Iterator[Reported]:
    """The verdicts of the rules of a cone on a trace, in the order of the trace. `moved` is the
    whole machine with the moved threshold.
    """
    at_ns = history.at_ns
    columns = np.column_stack(
        [_column(cone, moved, history, proposition) for proposition in cone.boundary]
    )
    for place, proposition in enumerate(cone.boundary):
        node = moved.propositions[proposition].node
        if proposition in cone.moved and isinstance(node, ir.AgeReaches):
            at_ns, columns = _with_ages(history, columns, place, node)
    interpreter = Interpreter(_residual(cone, moved))
    events: list[ir.Event] = []
    for row in np.flatnonzero(_is_new(columns, at_ns)):
        values = [_FLAGS[TruthValue(value)] for value in columns[row].tolist()]
        slots = dict(enumerate(flag for pair in values for flag in pair))
        events += interpreter.update(int(at_ns[row]), {0: ChannelValues(slots)})
    events += interpreter.advance(int(at_ns[-1]))
    for event in events:
        if isinstance(event, ir.Verdict):
            yield cone.rules[event.rule], int(event.change), event.at_ns


def _with_ages(
    history: History, columns: NDArray[np.int8], place: int, node: ir.AgeReaches
) -> tuple[NDArray[np.int64], NDArray[np.int8]]:
    """The rows, with an additional row whenever an age is reached between two of them."""
    at_ns, ages_ns = history.at_ns, history.ages_ns[node.input]
    due_ns = at_ns[:-1] + (node.age_ns - ages_ns[:-1])
    is_due = (ages_ns[:-1] >= 0) & (ages_ns[:-1] < node.age_ns) & (due_ns < at_ns[1:])
    rows = np.flatnonzero(is_due)
    more = columns[rows].copy()
    more[:, place] = TruthValue.TRUE
    return np.insert(at_ns, rows + 1, due_ns[rows]), np.insert(columns, rows + 1, more, axis=0)


def _is_new(columns: NDArray[np.int8], at_ns: NDArray[np.int64]) -> NDArray[np.bool_]:
    """The first row, the rows in which something changes, and the rows on both sides of a jump."""
    jumps = backwards(at_ns)
    found: NDArray[np.bool_] = jumps | np.append(jumps[1:], False)
    found[0] = True
    found[1:] |= np.any(np.diff(columns, axis=0) != 0, axis=1)
    return found


def _column(cone: Cone, moved: ir.Machine, history: History, proposition: int) -> NDArray[np.int8]:
    """The values of a proposition of the boundary, one for each row."""
    node = moved.propositions[proposition].node
    usual = history.propositions[:, proposition]
    if proposition not in cone.moved:
        return usual
    if isinstance(node, ir.Quantified):
        return _quantified(moved, history, proposition, node)
    if isinstance(node, ir.AgeReaches):
        made = history.ages_ns[node.input] >= node.age_ns
    else:
        made = _compared(moved, node, history.signals)
    return np.where(usual > TruthValue.TRUE, usual, made).astype(np.int8)


def _compared(
    machine: ir.Machine, node: ir.PropositionNode, values: Mapping[int, NDArray[np.float64]]
) -> NDArray[np.bool_]:
    """A comparison, computed again."""

    def of(signal: int) -> NDArray[np.float64] | float:
        its = machine.signals[signal].node
        return its.value if isinstance(its, ir.Constant) else values[signal]

    if isinstance(node, ir.Compare):
        return np.asarray(COMPARISONS[node.comparison](of(node.left), of(node.right)))
    assert isinstance(node, ir.Between)
    value = of(node.signal)
    return np.asarray((of(node.low) <= value) & (value <= of(node.high)))


def _quantified(
    machine: ir.Machine, history: History, proposition: int, node: ir.Quantified
) -> NDArray[np.int8]:
    """A comparison of elements, computed again, and its result for any or for all elements."""
    element = machine.propositions[node.element].node
    compared = {
        signal: history.elements[signal]
        for signal in compared_signals(element)
        if signal in history.elements
    }
    found = next(iter(compared.values()))
    values = {signal: elements.values for signal, elements in compared.items()}
    made = _compared(machine, element, values)
    is_known: NDArray[np.bool_] = ~np.any([np.isnan(each) for each in values.values()], axis=0)
    is_any = node.quantifier is ir.Quantifier.ANY
    deciding = made if is_any else ~made
    decided = _some(deciding & is_known, found)
    unclear = _some(~is_known, found)
    inputs = ir.supports(machine).propositions[proposition].inputs
    may_be_stale = any(machine.inputs[used].timeout_ns is not None for used in inputs)
    unknown = TruthValue.STALE if may_be_stale else TruthValue.UNKNOWN
    otherwise = np.where(unclear, int(unknown), int(not is_any))
    of_elements = np.where(decided, int(is_any), otherwise)[found.rows]
    # Without elements (an empty or unknown array or list), no threshold matters.
    is_empty = (found.starts == found.ends)[found.rows]
    return np.where(is_empty, history.propositions[:, proposition], of_elements).astype(np.int8)


def _some(flags: NDArray[np.bool_], found: ElementHistory) -> NDArray[np.bool_]:
    """A mask of the sequences in which at least one element has a flag."""
    before = np.append(0, np.cumsum(flags))
    return np.asarray(before[found.ends] > before[found.starts])
