"""Goals of the coverage of a rule: its conditions to MC/DC, thresholds, deadlines, stale inputs.

A rule has *decisions*: its condition, its release, and the operands of `for`, `since`, `once` and
`after`. A decision consists of *atoms*, joined by `and`, `or` and `not`. Atoms are comparisons and
other leaves, and whole expressions with `for`, `since`, `once` or `after`.

An atom is covered if a trace has shown it true and false while the decision depended on it alone.
This means that the opposite value of the atom would have given the decision the opposite value
(masking MC/DC). An atom that occurs twice in a decision is inverted in both places.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Iterator
from dataclasses import dataclass

from rossmarie import ir
from rossmarie.ir.support import (
    is_leaf,
    leaf_propositions,
    proposition_operands,
    supports,
)
from rossmarie.testing.whole import whole_step

LONGEST_SILENCE_NS = 10**16
"""The shortest silence that is too long for a test. An input with a longer timeout is stale only
until its first message.
"""


def stays(used: ir.Input) -> bool:
    """Say whether an input is stale only until its first message, as a static frame is."""
    return used.timeout_ns is not None and used.timeout_ns > LONGEST_SILENCE_NS


class Aspect(enum.Enum):
    """The aspect of a rule, an atom or an input that a trace has to show."""

    ACTIVE = "active"
    CLEARED = "cleared"
    TRUE = "true"
    FALSE = "false"
    UNDER = "just under"
    AT = "at"
    OVER = "just over"
    STALE = "stale"


@dataclass(frozen=True)
class TraceGoal:
    """An aspect that a trace has to show. `subject` is a proposition, or an input for STALE, or -1
    for the rule itself. `decision` is the proposition that the subject decides. `edge` tells the
    two ends of a range apart.
    """

    rule: int
    aspect: Aspect
    subject: int = -1
    decision: int = -1
    edge: int = 0


@dataclass(frozen=True)
class ComparisonEdge:
    """A signal and the constant that it is compared with. `step` is a small visible distance, in
    SI. Usually it is a thousandth, rounded to a power of ten of the unit that the user sees. With
    `is_whole`, it is the distance of two neighbors among the possible values of the signal.
    """

    signal: int
    threshold: float
    step: float
    constant: int
    is_whole: bool = False


def goals(machine: ir.Machine) -> Iterator[TraceGoal]:
    """All goals, rule by rule."""
    for index, rule in enumerate(machine.rules):
        yield TraceGoal(index, Aspect.ACTIVE)
        yield TraceGoal(index, Aspect.CLEARED)
        for decision in decisions(machine, rule):
            for atom in atoms(machine, decision):
                yield TraceGoal(index, Aspect.TRUE, atom, decision)
                yield TraceGoal(index, Aspect.FALSE, atom, decision)
                yield from _edges_of(machine, index, atom, decision)
        for used in losable_inputs(machine, rule):
            yield TraceGoal(index, Aspect.STALE, used)


def losable_inputs(machine: ir.Machine, rule: ir.Rule) -> list[int]:
    """The inputs of a rule that have a timeout and provide more than their age. The age keeps
    growing while the input is stale.
    """
    rests_on = supports(machine).propositions
    read: set[int] = set()
    for leaf in leaf_propositions(machine, rule.condition):
        if not isinstance(machine.propositions[leaf].node, ir.AgeReaches):
            read |= rests_on[leaf].inputs
    return [used for used in sorted(read) if machine.inputs[used].timeout_ns is not None]


def _edges_of(machine: ir.Machine, rule: int, atom: int, decision: int) -> Iterator[TraceGoal]:
    for number, _ in enumerate(edges(machine, atom)):
        for aspect in (Aspect.UNDER, Aspect.AT, Aspect.OVER):
            yield TraceGoal(rule, aspect, atom, decision, number)
    if deadline_ns(machine, atom) is not None:
        yield TraceGoal(rule, Aspect.UNDER, atom, decision)
        yield TraceGoal(rule, Aspect.AT, atom, decision)


def decisions(machine: ir.Machine, rule: ir.Rule) -> list[int]:
    """The decisions of a rule. The negation of a decision is not listed as another decision."""
    found: dict[int, None] = {}
    waiting = [*rule.roots]
    while waiting:
        decision = _plain(machine, waiting.pop(0))
        if decision in found or isinstance(machine.propositions[decision].node, ir.Literal):
            continue
        found[decision] = None
        for atom in atoms(machine, decision):
            waiting += _judged_over_time(machine, atom)
    return list(found)


def _judged_over_time(machine: ir.Machine, atom: int) -> tuple[int, ...]:
    """The operands of an atom over time; none for a leaf."""
    whole = ir.defined(machine, atom)
    if whole is not None:
        return whole.operands
    node = machine.propositions[atom].node
    return () if is_leaf(node) else proposition_operands(node)


def _plain(machine: ir.Machine, proposition: int) -> int:
    """The proposition at the end of a chain of `not`."""
    node = machine.propositions[proposition].node
    while isinstance(node, ir.Not) and ir.defined(machine, proposition) is None:
        proposition, node = node.operand, machine.propositions[node.operand].node
    return proposition


def atoms(machine: ir.Machine, decision: int) -> tuple[int, ...]:
    """The atoms of a decision, in order of index."""
    found: set[int] = set()
    waiting = [decision]
    while waiting:
        proposition = waiting.pop()
        node = machine.propositions[proposition].node
        is_over_time = isinstance(node, ir.Held | ir.Since | ir.Recurs) or ir.defined(
            machine, proposition
        )
        if is_over_time or is_leaf(node):
            found.add(proposition)
        elif not isinstance(node, ir.Literal):
            waiting.extend(proposition_operands(node))
    return tuple(sorted(found))


# --- thresholds and deadlines ----------------------------------------------------------------


def edges(machine: ir.Machine, proposition: int) -> list[ComparisonEdge]:
    """The thresholds of an atom: constants that it compares with a variable signal."""
    node = machine.propositions[proposition].node
    if isinstance(node, ir.Quantified):
        node = machine.propositions[node.element].node
    found = []
    for signal, constant in _pairs(node):
        value = machine.signals[constant].node
        is_number = not _is_text(machine, signal)
        if isinstance(value, ir.Constant) and is_number and not _is_constant(machine, signal):
            whole = whole_step(machine, signal)
            step = _step(machine, constant, value.value) if whole is None else whole
            found.append(ComparisonEdge(signal, value.value, step, constant, whole is not None))
    return found


def _pairs(node: ir.PropositionNode) -> tuple[tuple[int, int], ...]:
    """Pairs of compared signals."""
    match node:
        case ir.Compare(left=left, right=right):
            return (left, right), (right, left)
        case ir.Between(signal=signal, low=low, high=high):
            return (signal, low), (signal, high)
        case (
            ir.Literal() | ir.Flag() | ir.AgeReaches() | ir.Oscillates() | ir.Quantified()
            | ir.Not() | ir.And() | ir.Or() | ir.Held() | ir.Since() | ir.Recurs()
        ):  # fmt: skip
            return ()


def _is_constant(machine: ir.Machine, signal: int) -> bool:
    return isinstance(machine.signals[signal].node, ir.Constant)


def _is_text(machine: ir.Machine, signal: int) -> bool:
    node = machine.signals[signal].node
    if isinstance(node, ir.Element):
        return machine.arrays[node.array].kind is not ir.FieldKind.REAL
    return isinstance(node, ir.Read) and machine.slots[node.slot].kind is not ir.FieldKind.REAL


def _step(machine: ir.Machine, constant: int, value: float) -> float:
    shown = machine.signals[constant]
    return visible_step(value * shown.scale + shown.offset) / shown.scale


def visible_step(number: float) -> float:
    """A thousandth of a number, rounded down to a power of ten: 0.01 for 10, 0.0001 for 0.4."""
    if number == 0.0 or not math.isfinite(number):
        return 0.001
    return float(f"1e{math.floor(math.log10(abs(number))) - 3}")


def deadline_ns(machine: ir.Machine, atom: int) -> int | None:
    """The time in ns after which an atom becomes true (`once` and `after`: false). None if the atom
    does not depend on time.
    """
    held = ir.held_of(machine, atom)
    match machine.propositions[atom if held is None else held].node:
        case ir.Held(duration_ns=duration_ns) | ir.AgeReaches(age_ns=duration_ns):
            return duration_ns
        case (
            ir.Literal() | ir.Compare() | ir.Between() | ir.Flag() | ir.Oscillates()
            | ir.Quantified() | ir.Not() | ir.And() | ir.Or() | ir.Since() | ir.Recurs()
        ):  # fmt: skip
            return None


def deadline_step_ns(duration_ns: int) -> int:
    """A visible step of a duration, at least 1 ns."""
    return max(1, round(visible_step(duration_ns / 1e9) * 1e9))
