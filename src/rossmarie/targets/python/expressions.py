"""Numbers, comparisons and logic as Python expressions.

The input is a layout, and a function that writes operands. Operations have the order of the
interpreter, so that the results have the same bits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from rossmarie import core, ir
from rossmarie.targets.formulas import definition_of, definition_of_samples
from rossmarie.targets.python.functions import PYTHON
from rossmarie.targets.python.layout import PythonLayout, memory

Write = Callable[[int], str]
"""A function that writes a signal or a proposition, given its index."""


def applied(layout: PythonLayout, node: ir.Apply, write: Write) -> str:
    """A function of signals; NaN if it is not finite (S4)."""
    text = raw(node, write)
    is_infinite = any(may_be_infinite(layout, operand) for operand in node.operands)
    if not core.may_be_infinite(node.function, len(node.operands), of_infinite=is_infinite):
        return text
    return f"known({text})"


def raw(node: ir.Apply, write: Write) -> str:
    """A function of signals; a result that is too large is infinite."""
    operands = [write(operand) for operand in node.operands]
    return definition_of(node.function, len(operands)).call(PYTHON, operands)


def of_samples(node: ir.Sampled) -> str:
    """A function of samples; NaN if it is not finite (S4), unless it keeps infinities (S8)."""
    declared = core.sampling_row(node.function)
    views = [_view(node, view) for view in declared.views]
    text = definition_of_samples(node.function).call(PYTHON, views)
    return text if declared.keeps_infinities else f"known({text})"


def _view(node: ir.Sampled, view: core.SampleNumber) -> str:
    if view is core.SampleNumber.CONSTANT:
        return repr(float(node.window_ns) / 1e9)
    return f"{memory(node)}.{view.value}()"


def is_shown(node: ir.Apply, operand: int) -> bool:
    """Say whether a signal is finite whenever the result of this function of it is finite."""
    places = [place for place, each in enumerate(node.operands) if each == operand]
    return not core.shown_by(node.function, len(node.operands)).isdisjoint(places)


def may_be_infinite(layout: PythonLayout, signal: int) -> bool:
    """Say whether a signal can be an element of an array that is out of range (S8)."""
    match layout.machine.signals[signal].node:
        case ir.Element() | ir.Fold():
            return True
        case ir.Sampled(function=function, signal=sampled):
            keeps = core.sampling_row(function).keeps_infinities
            return keeps and may_be_infinite(layout, sampled)
        case ir.Constant() | ir.Read() | ir.Apply() | ir.Count():
            return False


# --- comparisons -----------------------------------------------------------------------------


def holds(node: ir.PropositionNode, write: Write) -> str:
    """The value of a comparison if no operand is unknown (S27 to S29)."""
    match node:
        case ir.Compare(comparison=comparison, left=left, right=right):
            return f"{write(left)} {comparison.value} {write(right)}"
        case ir.Between(signal=signal, low=low, high=high):
            return f"{write(low)} <= {write(signal)} <= {write(high)}"
        case ir.Flag(signal=signal):
            return f"{write(signal)} != 0.0"
        case (
            ir.Literal() | ir.AgeReaches() | ir.Oscillates() | ir.Quantified() | ir.Not()
            | ir.And() | ir.Or() | ir.Held() | ir.Since() | ir.Recurs()
        ):  # fmt: skip
            raise AssertionError(f"{type(node).__name__} does not compare")


def is_unknown(layout: PythonLayout, node: ir.PropositionNode, write: Write) -> str:
    """The condition that an operand of a comparison is NaN; empty if no operand can be NaN."""
    signals = dict.fromkeys(ir.compared_signals(node))
    nodes = layout.machine.signals
    variable = [s for s in signals if not isinstance(nodes[s].node, ir.Constant)]
    return " or ".join(f"{write(signal)} != {write(signal)}" for signal in variable)


def compared(layout: PythonLayout, node: ir.PropositionNode, write: Write, unknown: str) -> str:
    """A comparison as a proposition."""
    condition = is_unknown(layout, node, write)
    known = f"1 if {holds(node, write)} else 0"
    return f"{unknown} if {condition} else {known}" if condition else known


def unknown_kind(layout: PythonLayout, index: int) -> str:
    """S30: the value of an unknown leaf. It is 3 if an input with a timeout is missing, else 2."""
    support = layout.supports.propositions[index]
    if not layout.is_timed(support.inputs):
        return "2"
    if isinstance(layout.machine.propositions[index].node, ir.Quantified | ir.AgeReaches):
        return "3"
    slots = {f"x{slot}": {layout.machine.slots[slot].input} for slot in sorted(support.slots)}
    folds = {f"s{fold}": layout.supports.signals[fold].inputs for fold in sorted(support.folds)}
    samples = [f"s{sample}" for sample in sorted(support.samples)]
    if not folds and not samples and all(map(layout.is_timed, slots.values())):
        return "3"
    lacking = [
        f"{name} != {name}" for name, used in {**slots, **folds}.items() if layout.is_timed(used)
    ]
    measured = [f"{name} < INF" for name in slots]
    for signal in (*sorted(support.folds), *sorted(support.samples)):
        is_of_list = ir.is_of_list(layout.machine, layout.supports.signals[signal])
        measured.append(f"-INF < s{signal} < INF" if is_of_list else f"s{signal} < INF")
    return f"(3 if {' or '.join([*lacking, ' and '.join(measured) or 'True'])} else 2)"


# --- logic -----------------------------------------------------------------------------------


def logic(node: ir.PropositionNode, write: Write) -> str:
    """A compound proposition (S2)."""
    match node:
        case ir.Literal(value=value):
            return str(int(value))
        case ir.Not(operand=operand):
            text = write(operand)
            return f"{text} if {text} > 1 else 1 - {text}"
        case ir.And(operands=operands):
            return both(*map(write, operands))
        case ir.Or(operands=operands):
            return either(*map(write, operands))
        case (
            ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches() | ir.Oscillates()
            | ir.Quantified() | ir.Held() | ir.Since() | ir.Recurs()
        ):  # fmt: skip
            raise AssertionError(f"{type(node).__name__} is no logic")


def both(*parts: str) -> str:
    """The conjunction of propositions."""
    return f"{' and '.join(parts)} and {_greatest(parts)}"


def either(*parts: str) -> str:
    """The disjunction of propositions."""
    return f"1 if {' or '.join(f'{part} == 1' for part in parts)} else {_greatest(parts)}"


def _greatest(parts: Iterable[str]) -> str:
    different = list(dict.fromkeys(parts))
    if len(different) == 2:  # an expression is much faster than a call
        return "({0} if {0} > {1} else {1})".format(*different)
    return f"max({', '.join(different)})" if len(different) > 2 else different[0]
