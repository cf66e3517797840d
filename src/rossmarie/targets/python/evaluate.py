"""One evaluation: inputs expire, then every signal, every proposition and every rule is evaluated
(S11).

The input is a layout. A number that is still inside its guard is skipped, with all its comparisons.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator, Sequence

from rossmarie import ir
from rossmarie.core import sampling_row
from rossmarie.targets import comments
from rossmarie.targets.python import expressions, names, state
from rossmarie.targets.python.channels import calm_channels
from rossmarie.targets.python.function import StartFunction
from rossmarie.targets.python.layout import PythonLayout, ValueLimits, memory

_MOST_LINES = 2000
"""The most lines of a function. Python's compiler takes disproportionately long for much longer
functions.
"""


def evaluate(layout: PythonLayout) -> list[str]:
    """The function that evaluates at an instant; `updated` has a bit for each channel. If the
    function is long, it is divided, and the functions for its parts come before it.
    """
    function = StartFunction("evaluate(at_ns, updated)")
    state.expire(layout, function)
    parts = _parts(layout)
    if len(parts) == 1:
        function.take(parts[0])
    else:
        for part in parts:
            function.line(part.head)
    function.assign("now", "at_ns")
    state.look_for_timers(layout, function)
    function.assign("wake", "first")
    _calm(layout, function)
    before = parts if len(parts) > 1 else []
    return [line for each in (*before, function) for line in each.text()]


def _parts(layout: PythonLayout) -> list[StartFunction]:
    """The steps of an evaluation, in their order, divided into functions."""
    parts = [StartFunction("evaluate_0(at_ns, updated)")]
    for step in _steps(layout):
        if parts[-1].length + step.length > _MOST_LINES:
            parts.append(StartFunction(f"evaluate_{len(parts)}(at_ns, updated)"))
        parts[-1].take(step)
    return parts


def _steps(layout: PythonLayout) -> Iterator[StartFunction]:
    """The signals, the propositions and the rules. The numbers beside elements, and the results
    over these elements, come first.
    """
    for index in layout.signals:
        if index in layout.made_beside:
            yield _signal(layout, index)
    for array in layout.numbers_beside:
        yield _look(layout, array)
    for index in layout.signals:
        if index not in layout.made_beside:
            yield _signal(layout, index)
    for guard in layout.guards:
        yield _guard(layout, guard)
    for index in layout.kept:
        if index not in layout.guarded:
            yield _proposition(layout, index)
    for number, rule in enumerate(layout.machine.rules):
        yield _rule(layout, number, rule)


def _remark(function: StartFunction, part: ir.Signal | ir.Proposition | ir.Rule, text: str) -> None:
    function.line(f"# {comments.after_hash(f'{names.place(part.span)}  {text}')}")


def _look(layout: PythonLayout, array: int) -> StartFunction:
    """S74: the results over elements that arrived, with the numbers of this evaluation beside
    them.
    """
    function = StartFunction("step()")
    channel = layout.channel(layout.machine.arrays[array].input)
    elements = ", ".join(f"kept_{column}" for column in layout.beside(array))
    function.line(f"if updated & {1 << channel}:")
    function.line(f"look_{array}({elements})", 1)
    return function


# --- signals ---------------------------------------------------------------------------------


def _signal(layout: PythonLayout, index: int) -> StartFunction:
    function = StartFunction("step()")
    signal = layout.machine.signals[index]
    match signal.node:
        case ir.Apply():
            text = expressions.applied(layout, signal.node, layout.value)
        case ir.Sampled() if memory(signal.node) in layout.memories:
            _sample(layout, index, signal.node, function)
            text = _of_samples(signal.node)
        case (
            ir.Constant() | ir.Read() | ir.Sampled() | ir.Element() | ir.Fold()
            | ir.Count()
        ):  # fmt: skip
            return function  # known at compile time, or computed when a message arrives
    _remark(function, signal, signal.text)
    function.assign(f"s{index}", text)
    return function


def _sample(layout: PythonLayout, index: int, node: ir.Sampled, function: StartFunction) -> None:
    """S18: take a sample, once for all signals that use the same samples."""
    name = memory(node)
    users = (
        i
        for i, signal in enumerate(layout.machine.signals)
        if isinstance(signal.node, ir.Sampled) and memory(signal.node) == name
    )
    if next(users) == index:
        function.line(f"if updated & {_bits(layout, node.signal)}:")
        function.line(f"{name}.take({layout.value(node.signal)}, at_ns)", 1)
        if sampling_row(node.function).feeds_back:
            function.line(f"{name}.take({expressions.of_samples(node)}, at_ns)", 1)


def _of_samples(node: ir.Sampled) -> str:
    """The value of a function of samples; it is stored as a result if the function feeds back."""
    feeds_back = sampling_row(node.function).feeds_back
    return f"{memory(node)}.newest()" if feeds_back else expressions.of_samples(node)


def _bits(layout: PythonLayout, signal: int) -> int:
    return sum(1 << channel for channel in layout.supports.signals[signal].channels)


# --- propositions
# ----------------------------------------------------------------------------------


def _record(
    layout: PythonLayout, index: int, value: str, function: StartFunction, depth: int = 0
) -> None:
    """Set a proposition. If a verdict reports it, also set the instant since which it has its value
    (S34).
    """
    if index not in layout.terms:
        function.assign(f"t{index}", value, depth)
        return
    if value != "v":
        function.line(f"v = {value}", depth)
    function.line(f"if v != t{index}:", depth)
    function.assign(f"t{index}", "v", depth + 1)
    function.assign(f"d{index}", "at_ns", depth + 1)


def _guard(layout: PythonLayout, guard: ValueLimits) -> StartFunction:
    """The code for a number that has left its guard: evaluate its comparisons, and find its new
    guard.
    """
    function = StartFunction("step()")
    value = guard.value
    for leaf in guard.leaves:
        proposition = layout.machine.propositions[leaf]
        _remark(function, proposition, proposition.text)
    function.line(f"if not {guard.low} < {value} <= {guard.high}:")
    function.line(f"if {value} == {value}:", 1)
    for leaf in guard.leaves:
        holds = expressions.holds(layout.machine.propositions[leaf].node, layout.value)
        _record(layout, leaf, f"1 if {holds} else 0", function, 2)
    _gap(guard, [-math.inf, *guard.cuts, sys.float_info.max], function, 2)
    function.line("else:", 1)
    function.assign(guard.low, "INF", 2)
    function.line(f"v = {expressions.unknown_kind(layout, guard.leaves[0])}", 2)
    for leaf in guard.leaves:
        _record(layout, leaf, "v", function, 2)
    return function


def _gap(guard: ValueLimits, cuts: Sequence[float], function: StartFunction, depth: int) -> None:
    """Find the gap between two cuts by bisection. All cuts except the outer two are limits."""
    if len(cuts) > 2:
        middle = len(cuts) // 2
        function.line(f"if {guard.value} <= {cuts[middle]!r}:", depth)
        _gap(guard, cuts[: middle + 1], function, depth + 1)
        function.line("else:", depth)
        _gap(guard, cuts[middle:], function, depth + 1)
        return
    low, high = cuts
    function.assign(guard.low, "-INF" if low == -math.inf else repr(low), depth)
    function.assign(guard.high, "MAX" if high == sys.float_info.max else repr(high), depth)


def _proposition(layout: PythonLayout, index: int) -> StartFunction:
    function = StartFunction("step()")
    proposition = layout.machine.propositions[index]
    _remark(function, proposition, proposition.text)
    match proposition.node:
        case ir.Held():
            _held(layout, index, proposition.node, function)
        case ir.Since():
            _since(layout, index, proposition.node, function)
        case ir.Oscillates():
            _oscillates(layout, index, proposition.node, function)
        case ir.Recurs(operand=operand):
            value = f"recurrence_{index}.look({layout.proposition(operand)}, at_ns)"
            _record(layout, index, value, function)
        case (
            ir.Literal() | ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches()
            | ir.Quantified() | ir.Not() | ir.And() | ir.Or()
        ):  # fmt: skip
            _record(layout, index, _text(layout, index, proposition.node), function)
    return function


def _text(layout: PythonLayout, index: int, node: ir.PropositionNode) -> str:
    match node:
        case ir.AgeReaches(input=used, age_ns=age_ns):
            known = f"1 if at_ns - stamp_{layout.channel(used)} >= {age_ns} else 0"
            is_never = f"{layout.state_of_input[used]} == 0"
            return f"{expressions.unknown_kind(layout, index)} if {is_never} else {known}"
        case ir.Quantified():
            unknown = expressions.unknown_kind(layout, index)
            return f"q{index}" if unknown == "2" else f"{unknown} if q{index} == 2 else q{index}"
        case ir.Compare() | ir.Between() | ir.Flag():
            unknown = expressions.unknown_kind(layout, index)
            return expressions.compared(layout, node, layout.value, unknown)
        case (
            ir.Literal() | ir.Not() | ir.And() | ir.Or() | ir.Oscillates() | ir.Held()
            | ir.Since()
            | ir.Recurs()
        ):  # fmt: skip
            return expressions.logic(node, layout.proposition)


def _held(layout: PythonLayout, index: int, node: ir.Held, function: StartFunction) -> None:
    """S33: a `for`."""
    function.line(f"v = {layout.proposition(node.operand)}")
    function.line("if v != 1:")
    function.assign(f"due_{index}", "NEVER", 1)
    function.assign(f"before_{index}", "v", 1)
    function.line("else:")
    function.line(f"if due_{index} == NEVER:", 1)
    function.assign(f"due_{index}", f"at_ns + {node.duration_ns}", 2)
    function.line(f"if at_ns < due_{index}:", 1)
    function.line(f"v = before_{index}", 2)
    _record(layout, index, "v", function)


def _since(layout: PythonLayout, index: int, node: ir.Since, function: StartFunction) -> None:
    """S44: a `since`."""
    held, begun = layout.proposition(node.held), layout.proposition(node.begun)
    function.line(f"v = {expressions.either(begun, f'before_{index}')}")
    function.line(f"v = {expressions.both(held, 'v')}")
    function.line(f"v = {expressions.either(begun, 'v')}")
    function.assign(f"before_{index}", "v")
    _record(layout, index, "v", function)


def _oscillates(
    layout: PythonLayout, index: int, node: ir.Oscillates, function: StartFunction
) -> None:
    """S32: an oscillation."""
    if not layout.supports.signals[node.signal].channels:
        _record(layout, index, "0", function)
        return
    value, swinging = layout.value(node.signal), f"oscillation_{index}"
    function.line(f"if {value} - {value} == 0.0:")
    function.line(f"if updated & {_bits(layout, node.signal)}:", 1)
    function.line(f"{swinging}.take({value}, at_ns)", 2)
    function.line("v = 1", 1)
    function.line("else:")
    function.line(f"v = {expressions.unknown_kind(layout, index)}", 1)
    function.line(f"{swinging}.clear()", 1)
    _record(layout, index, f"{swinging}.recent.look(v, at_ns)", function)


# --- rules -----------------------------------------------------------------------------------


def _rule(layout: PythonLayout, number: int, rule: ir.Rule) -> StartFunction:
    """S35 to S37: a rule."""
    function = StartFunction("step()")
    condition = layout.proposition(rule.condition)
    _remark(function, rule, f"{rule.name}: {rule.contract}")
    function.line(f"if not active_{number}:")
    function.line(f"v = 1 if {condition} == 1 else 2 if {condition} == 3 else -1", 1)
    function.line("else:")
    if rule.release is None:
        function.line("v = -1", 1)
    else:
        release = layout.proposition(rule.release)
        is_over = f"{condition} == 0" + ("" if release == "1" else f" and {release} == 1")
        function.line(f"v = 0 if {is_over} else -1", 1)
    function.line("if v >= 0:")
    tell(layout, number, "v", function)
    return function


def tell(layout: PythonLayout, number: int, change: str, function: StartFunction) -> None:
    """Change a rule and report it, with a snapshot of the values that it depends on (S41). The code
    is indented by one level.
    """
    rule = layout.machine.rules[number]
    function.assign(f"active_{number}", "False" if change == "0" else f"{change} > 0", 1)
    snapshot = [
        str(number),
        "at_ns",
        change,
        names.tuple_of(layout.proposition(term) for term in rule.terms),
        names.tuple_of(f"d{term}" for term in rule.terms),
        names.tuple_of(f"float({layout.value(signal)})" for signal in rule.signals),
        names.tuple_of(layout.state_of_input[used] for used in rule.inputs),
    ]
    function.line("events.append(", 1)
    function.line(f"Verdict({', '.join(snapshot)})", 2)
    function.line(")", 1)


def _calm(layout: PythonLayout, function: StartFunction) -> None:
    """Compute the instant until which a message on a channel may be calm."""
    channels = calm_channels(layout)
    if not channels:
        return
    function.line("calm = first if first < LATEST else LATEST")
    for channel in channels:
        fresh = [f"{group.state} == 1" for group in layout.groups if group.channel == channel]
        young = [f"t{i} == 0" for i, age in layout.ages if layout.channel(age.input) == channel]
        condition = " and ".join([*fresh, *young]) or "True"
        function.assign(f"calm_{channel}", f"calm if {condition} else EARLIEST")
