"""A machine as text for readers: one line per part, in the order of the machine.

Signals are written as `s0`, propositions as `t0`, tasks as `k0`. The user's text and its place
follow the bar.
"""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie.ir import model as ir
from rossmarie.ir.duration_text import duration_text
from rossmarie.ir.feedback import NO_FEEDBACK
from rossmarie.ir.path import Path, path_text
from rossmarie.ir.reactions_text import reaction_sections

_WIDTH = 44


def dump_text(machine: ir.Machine) -> str:
    """A readable dump; the same machine gives the same text."""
    sections = (
        tuple(_head(machine)),
        tuple(_channels(machine)),
        tuple(_inputs(machine)),
        tuple(_sources(machine)),
        tuple(f"text {i} = {_quoted(text)}" for i, text in enumerate(machine.texts)),
        tuple(_signals(machine)),
        tuple(_propositions(machine)),
        tuple(line for rule in machine.rules for line in _rule(rule)),
        tuple(_hazards(machine)),
        *reaction_sections(machine),
    )
    return "\n\n".join("\n".join(section) for section in sections if section) + "\n"


def _head(machine: ir.Machine) -> Iterator[str]:
    yield f"machine {machine.name}"
    if machine.left_out is not None:
        only = ", ".join(each.value for each in machine.left_out.only)
        yield f"only {only}; left out {', '.join(machine.left_out.rules) or 'none'}"


def _channels(machine: ir.Machine) -> Iterator[str]:
    for index, channel in enumerate(machine.channels):
        gaps = "" if channel.gaps_ns is None else ", gaps {} to {} ns".format(*channel.gaps_ns)
        yield f"channel {index} = {channel.topic} : {channel.message_type}{gaps}"


def _inputs(machine: ir.Machine) -> Iterator[str]:
    for index, declared in enumerate(machine.inputs):
        timeout = declared.timeout_ns
        suffix = "" if timeout is None else f" timeout {duration_text(timeout)}"
        line = f"input {index} = {declared.name} of channel {declared.channel}{suffix}"
        yield f"{line:{_WIDTH}} | {declared.span}"


def _sources(machine: ir.Machine) -> Iterator[str]:
    for index, slot in enumerate(machine.slots):
        conversion = _conversion(slot.scale, slot.offset)
        line = f"slot {index} = {slot.kind.value} of input {slot.input}{_path(slot.path)}"
        yield f"{line}{_in_unit(slot.unit)}{conversion}{_within(slot.limits)}"
    for index, each in enumerate(machine.lists):
        yield f"list {index} = of input {each.input}{_path(each.path)} up to {each.most}"
    for index, array in enumerate(machine.arrays):
        conversion = _conversion(array.scale, array.offset)
        of_list = "" if array.list is None else f"list {array.list}, {array.kind.value} "
        line = f"array {index} = {of_list}of input {array.input}{_path(array.path)}"
        yield f"{line}{_in_unit(array.unit)}{conversion}{_within(array.limits)}"


def _path(path: Path) -> str:
    return f" {path_text(path)}" if path else ""


def _in_unit(unit: str) -> str:
    return f" in {unit}" if unit else ""


def _conversion(scale: float, offset: float) -> str:
    return "" if (scale, offset) == (1.0, 0.0) else f", times {scale!r} plus {offset!r}"


def _within(limits: tuple[float, float] | None) -> str:
    return "" if limits is None else ", whole from {:.20g} to {:.20g}".format(*limits)


def _signals(machine: ir.Machine) -> Iterator[str]:
    for index, signal in enumerate(machine.signals):
        line = f"s{index} = {_signal(signal.node)}"
        yield f"{line:{_WIDTH}} | {signal.text}{_in_unit(signal.unit)} | {signal.span}"


def _signal(node: ir.SignalNode) -> str:
    match node:
        case ir.Constant(value=value):
            return repr(value)
        case ir.Read(slot=slot):
            return f"read slot {slot}"
        case ir.Apply(function=function, operands=operands):
            return f"{function.value} {_names('s', operands)}"
        case ir.Sampled(function=function, signal=signal, window_ns=window_ns):
            window = f" over {duration_text(window_ns)}" if window_ns else ""
            return f"{function.value} s{signal}{window}"
        case ir.Element(array=array):
            return f"element of array {array}"
        case ir.Fold(folding=folding, element=element):
            return f"{folding.value} over elements s{element}"
        case ir.Count(element=element):
            return f"count over elements t{element}"


def _propositions(machine: ir.Machine) -> Iterator[str]:
    for index, proposition in enumerate(machine.propositions):
        line = f"t{index} = {_proposition(proposition.node)}"
        name = f"{proposition.name}: " if proposition.name else ""
        yield f"{line:{_WIDTH}} | {name}{proposition.text} | {proposition.span}"


def _proposition(node: ir.PropositionNode) -> str:
    match node:
        case ir.Literal(value=value):
            return str(value).lower()
        case ir.Not(operand=operand):
            return f"not t{operand}"
        case ir.And(operands=operands):
            return f"and {_names('t', operands)}"
        case ir.Or(operands=operands):
            return f"or {_names('t', operands)}"
        case ir.Held(operand=operand, duration_ns=duration_ns, initially=initially):
            counts = ", true before the start" if initially else ""
            return f"t{operand} for {duration_text(duration_ns)}{counts}"
        case ir.Since(held=held, begun=begun):
            return f"t{held} since t{begun}"
        case ir.Recurs(operand=operand, count=count, window_ns=window_ns):
            return f"{count} edges of t{operand} within {duration_text(window_ns)}"
        case ir.Quantified(quantifier=quantifier, element=element):
            return f"{quantifier.value} over elements t{element}"
        case ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches() | ir.Oscillates():
            return _leaf(node)


def _leaf(node: ir.Compare | ir.Between | ir.Flag | ir.AgeReaches | ir.Oscillates) -> str:
    match node:
        case ir.Compare(comparison=comparison, left=left, right=right):
            return f"s{left} {comparison.value} s{right}"
        case ir.Between(signal=signal, low=low, high=high):
            return f"s{signal} in [s{low}, s{high}]"
        case ir.Flag(signal=signal):
            return f"flag s{signal}"
        case ir.AgeReaches(input=used, age_ns=age_ns):
            return f"age of input {used} >= {duration_text(age_ns)}"
        case ir.Oscillates(signal=signal, count=count, window_ns=window_ns, swing=swing):
            window = duration_text(window_ns)
            return f"s{signal} oscillates {count} times within {window} by {swing!r}"


def _rule(rule: ir.Rule) -> Iterator[str]:
    release = "latched" if rule.release is None else f"release t{rule.release}"
    line = f"rule {rule.name} = if t{rule.condition}, {release}"
    yield f"{line:{_WIDTH}} | {rule.contract} | {rule.span}"
    yield f"  actions {', '.join(rule.actions)}"
    yield f"  terms {_names('t', rule.terms)}; signals {_names('s', rule.signals)}"
    if rule.always:
        yield "  always"
    if rule.exempts is not None:
        permits = ", ".join(rule.exempts.permits) or "nothing"
        yield f"  exempts {rule.exempts.rule}: {rule.exempts.doing}, which permits {permits}"
    if rule.categories:
        yield f"  categories {', '.join(each.value for each in rule.categories)}"
    if rule.feedback != NO_FEEDBACK:
        once, lasting = rule.feedback.per_activation, rule.feedback.per_second
        margin = rule.feedback.margin
        reported = "" if margin is None else f", margin s{margin.signal}{_in_unit(margin.unit)}"
        yield f"  feedback {once:g} per activation, {lasting:g} per s{reported}"


def _hazards(machine: ir.Machine) -> Iterator[str]:
    for index, hazard in enumerate(machine.hazards):
        rules = (rule.name for rule in machine.rules if index in rule.hazards)
        line = f"hazard {hazard.name} = {_quoted(hazard.text)}, mitigated by {', '.join(rules)}"
        yield f"{line:{_WIDTH}} | {hazard.span}"


def _names(letter: str, indexes: tuple[int, ...]) -> str:
    return ", ".join(f"{letter}{index}" for index in indexes) or "none"


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
