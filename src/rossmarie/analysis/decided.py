"""Rules that are never or always active, and parts of conditions that are constant.

The checker reports conditions that constants alone decide. This module also uses the possible
values of numbers.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import partial

from dslkit.diagnostics import Diagnostic, Label, Remark
from rossmarie.analysis import thresholds
from rossmarie.analysis.errors import (
    AlwaysActive,
    ConstantPart,
    Decided,
    NeverActive,
    NumberIs,
    Undecided,
)
from rossmarie.analysis.finding import Finding
from rossmarie.analysis.inquiry import Inquiry, has_value, is_value
from rossmarie.analysis.witness import shown_value
from rossmarie.core import row
from rossmarie.ir import (
    AgeReaches,
    And,
    Apply,
    Array,
    Between,
    Compare,
    Constant,
    Count,
    Element,
    FieldKind,
    Flag,
    Fold,
    Held,
    Literal,
    Machine,
    Not,
    Or,
    Oscillates,
    Quantified,
    Read,
    Recurs,
    Response,
    Sampled,
    Since,
    Slot,
    TruthValue,
    compared_signals,
    defined,
    is_leaf,
    kleene,
    proposition_operands,
    reachable_propositions,
    reported_propositions,
)
from rossmarie.ir.carried import si_ends

NEVER, ALWAYS = TruthValue.TRUE, TruthValue.FALSE
"""The two kinds of constant parts, by the value that the part cannot have."""


def find_decided(inquiry: Inquiry, *, thorough: bool) -> Iterator[Finding]:
    """A warning for each rule that is never or always active, and for each other constant part of a
    condition. With `thorough`, there are also findings for the undecided queries about the rules.
    """
    machine = inquiry.machine
    constant = _constant_parts(inquiry)
    explained: set[int] = set()
    for index, rule in enumerate(machine.rules):
        below = reachable_propositions(machine, rule.condition)
        lacking = _lacking(machine, constant, rule.condition)
        if lacking is not None and rule.inputs:
            explained |= set(below)
            cause = next(((each, constant[each]) for each in below if each in constant), None)
            yield Finding(_rule_finding(inquiry, index, lacking, cause))
        elif thorough:
            yield from _open_queries(inquiry, index)
    for proposition, lacking in constant.items():
        if proposition not in explained:
            yield Finding(_part_finding(machine, proposition, lacking))


def _lacking(
    machine: Machine, constant: Mapping[int, TruthValue], proposition: int
) -> TruthValue | None:
    """The value that a proposition never has, if there is one. `not` and `for` inherit it from
    their operand, `since` from the proposition that begins it.
    """
    if proposition in constant:
        return constant[proposition]
    match machine.propositions[proposition].node:
        case Held(operand=operand) | Since(begun=operand):
            return _lacking(machine, constant, operand)
        case Not(operand=operand):
            inner = _lacking(machine, constant, operand)
            return None if inner is None else kleene.negation(inner)
        case (
            Literal() | Compare() | Between() | Flag() | AgeReaches() | Oscillates()
            | Quantified() | And() | Or() | Recurs()
        ):  # fmt: skip
            return None


def _impossible(inquiry: Inquiry, proposition: int) -> TruthValue | None:
    """The value, T or F, that a proposition is proved never to have. F counts only after the
    proposition has settled.
    """
    alone = inquiry.below(proposition)
    last = len(alone.machine.propositions) - 1
    for value in (NEVER, ALWAYS):
        if alone.is_impossible(
            partial(is_value, proposition=last, value=value), settled=value is ALWAYS
        ):
            return value
    return None


def _can_be(inquiry: Inquiry, proposition: int, value: bool) -> bool:
    """Say whether the solver finds that a leaf can have a value. If it does, the opposite cannot be
    proved.
    """
    alone = inquiry.below(proposition)
    last = len(alone.machine.propositions) - 1
    predicate = partial(
        is_value, proposition=last, value=TruthValue.TRUE if value else TruthValue.FALSE
    )
    return alone.is_possible(predicate, settled=not value)


# --- parts -----------------------------------------------------------------------------------


def _constant_parts(inquiry: Inquiry) -> dict[int, TruthValue]:
    """The innermost parts of conditions and releases that never have some value, each with this
    value.
    """
    machine = inquiry.machine
    found: dict[int, TruthValue] = {}
    rests_on = inquiry.asked.supports.propositions
    used = {
        proposition
        for rule in machine.rules
        for root in rule.roots
        for proposition in reachable_propositions(machine, root)
    }
    plain = {
        proposition
        for proposition in used
        if isinstance(machine.propositions[proposition].node, Literal | Not | Held | Since)
        or not rests_on[proposition].inputs
        or _is_free(machine, proposition)
    }
    varied = plain | thresholds.varied(machine, sorted(used - plain), partial(_can_be, inquiry))
    for proposition in sorted(used):
        if proposition in varied or _joins_apart(inquiry, proposition, varied):
            varied.add(proposition)
            continue
        if any(below in found for below in reachable_propositions(machine, proposition)):
            continue
        lacking = _impossible(inquiry, proposition)
        if lacking is None:
            varied.add(proposition)
        else:
            found[proposition] = lacking
    return _as_written(machine, found)


def _as_written(machine: Machine, found: Mapping[int, TruthValue]) -> dict[int, TruthValue]:
    """The constant parts that users wrote. An `after` whose cause never occurs is always true."""
    reported = {
        proposition
        for rule in machine.rules
        for root in rule.roots
        for proposition in reported_propositions(machine, root)
    }
    wholes = {proposition: defined(machine, proposition) for proposition in reported}
    written = {
        proposition: lacking for proposition, lacking in found.items() if proposition in reported
    }
    for proposition, whole in wholes.items():
        inside = set(reachable_propositions(machine, proposition)) - reported
        if isinstance(whole, Response) and NEVER in map(found.get, inside):
            written[proposition] = ALWAYS
    return dict(sorted(written.items()))


def _is_free(machine: Machine, proposition: int) -> bool:
    """Say whether a proposition compares only one number from a message with constants, and the
    number can lie on both sides of each constant.
    """
    nodes = [
        machine.signals[each].node
        for each in compared_signals(machine.propositions[proposition].node)
    ]
    others = [node for node in nodes if not isinstance(node, Constant)]
    if len(others) != 1 or not isinstance(others[0], Read):
        return False
    slot = machine.slots[others[0].slot]
    return (slot.kind is FieldKind.REAL and slot.limits is None) or len(nodes) == 1


def _joins_apart(inquiry: Inquiry, proposition: int, varied: set[int]) -> bool:
    """Say whether the parts of an `and` or `or` can be true and false, and depend on different
    messages.
    """
    node = inquiry.machine.propositions[proposition].node
    operands = proposition_operands(node)
    if is_leaf(node) or not varied.issuperset(operands):
        return False
    channels = [inquiry.asked.supports.propositions[operand].channels for operand in operands]
    return len(frozenset().union(*channels)) == sum(map(len, channels))


def _rule_finding(
    inquiry: Inquiry, index: int, lacking: TruthValue, cause: tuple[int, TruthValue] | None
) -> Diagnostic:
    machine = inquiry.machine
    rule = machine.rules[index]
    labels: tuple[Label, ...] = ()
    notes: tuple[Remark, ...] = ()
    if cause is not None:
        part, value = cause
        labels = (Decided(outcome=_WORDS[value]).at(machine.propositions[part].span),)
        notes = _reasons(machine, part)
    span = rule.head
    if lacking is ALWAYS:
        return AlwaysActive(rule=rule.name).at(span, *labels, notes=notes)
    is_stale = partial(is_value, proposition=rule.condition, value=TruthValue.STALE)
    can_be_stale = not inquiry.is_impossible(is_stale)
    rest = "only a missing input makes it active" if can_be_stale else "nothing makes it active"
    return NeverActive(rule=rule.name, rest=rest).at(span, *labels, notes=notes)


def _part_finding(machine: Machine, proposition: int, lacking: TruthValue) -> Diagnostic:
    part = machine.propositions[proposition]
    finding = ConstantPart(condition=part.text, outcome=_WORDS[lacking])
    return finding.at(part.span, notes=_reasons(machine, proposition))


_WORDS = {NEVER: "never true", ALWAYS: "always true"}


# --- reasons ---------------------------------------------------------------------------------


def _reasons(machine: Machine, proposition: int) -> tuple[Remark, ...]:
    """The values that the numbers in a leaf can have, as notes."""
    node = machine.propositions[proposition].node
    if isinstance(node, Quantified):
        return _reasons(machine, node.element)
    return tuple(
        NumberIs(number=machine.signals[signal].text, range=_range(machine, signal))
        for signal in compared_signals(node)
        if _range(machine, signal)
    )


def _range(machine: Machine, signal: int) -> str:
    match machine.signals[signal].node:
        case Apply(function=function):
            low, high = row(function).range
        case Count():
            low, high = 0.0, math.inf
        case Read(slot=slot) if machine.slots[slot].limits is not None:
            return f"{_whole(machine, signal, machine.slots[slot])}, as its type says"
        case Element(array=array) if machine.arrays[array].limits is not None:
            return f"{_whole(machine, signal, machine.arrays[array])}, as its type says"
        case Fold(element=element):
            return _range(machine, element)
        case Constant() | Read() | Sampled() | Element():
            return ""
    if high == math.inf:
        return "never negative" if low == 0.0 else ""
    return f"between {shown_value(machine, signal, low)} and {shown_value(machine, signal, high)}"


def _whole(machine: Machine, signal: int, source: Slot | Array) -> str:
    """The values that a field of whole numbers can hold, in words."""
    assert source.limits is not None, "asked before"
    low, high = (shown_value(machine, signal, end) for end in si_ends(source, source.limits))
    what = "a whole number between" if source.scale == 1.0 else "between"
    return f"{what} {low} and {high}"


# --- what stays open -------------------------------------------------------------------------


def _open_queries(inquiry: Inquiry, index: int) -> Iterator[Finding]:
    """Findings for the undecided queries about a rule: whether it can be active, and inactive."""
    machine = inquiry.machine
    rule = machine.rules[index]
    for value, word in ((TruthValue.TRUE, "true"), (TruthValue.FALSE, "false")):
        query = has_value(rule.condition, value)
        if inquiry.witness(query) is None:
            finding = Undecided(
                query=f"can the condition of rule `{rule.name}` be {word}?",
                reason="no short trace shows it, and no proof excludes it",
            )
            yield Finding(finding.at(rule.head))
