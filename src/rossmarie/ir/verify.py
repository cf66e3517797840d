"""Verify between passes that a machine is well formed, so that targets need no checks.

When `verify` returns: every index is in range; every operand is before its user; elementwise nodes
are below a fold, a count or a quantifier; constants and scales are finite; durations are valid.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

from rossmarie.core import Function, RegionFunction, row, sampling_row
from rossmarie.ir import model as ir
from rossmarie.ir.beside import stand_beside
from rossmarie.ir.feedback import Margin
from rossmarie.ir.malformed import (
    MalformedMachine,
    require,
    require_duration,
    require_finite,
    require_index,
)
from rossmarie.ir.model import FieldKind
from rossmarie.ir.path import EACH, Doing, Path, Quantity
from rossmarie.ir.settings import setting_numbers
from rossmarie.ir.signs import Comparison
from rossmarie.ir.support import (
    ElementArrays,
    columns_of,
    compared_signals,
    element_arrays,
    kind_of,
    proposition_operands,
    reachable_propositions,
    rule_signals,
    signal_operands,
    supports,
)
from rossmarie.ir.terms import rule_terms
from rossmarie.ir.verify_reactions import verify_reactions

_EQUALITY = (Comparison.EQUAL, Comparison.NOT_EQUAL)


def verify(machine: ir.Machine) -> None:
    """Raise `MalformedMachine` at the first defect. The error names the node and its defect."""
    _verify_inputs(machine)
    _verify_signals(machine)
    _verify_propositions(machine)
    arrays = _verified_arrays(machine)
    _verify_counts(machine)
    _verify_element_use(machine, arrays)
    _verify_kinds(machine)
    _verify_rules(machine, arrays)
    _verify_asked(machine, arrays)
    verify_reactions(machine)


def _require_before(operands: Iterable[int], user: int, where: str) -> None:
    for operand in operands:
        require(0 <= operand < user, where, f"operand {operand} does not stand before its user")


# --- inputs ----------------------------------------------------------------------------------


def _verify_inputs(machine: ir.Machine) -> None:
    for index, channel in enumerate(machine.channels):
        if channel.gaps_ns is not None:
            least, greatest = channel.gaps_ns
            is_order = 0 < least <= greatest
            require(is_order, f"channel {index}", f"gaps from {least} to {greatest} ns")
    for index, declared in enumerate(machine.inputs):
        where = f"input {index}"
        require_index(declared.channel, len(machine.channels), where, "channel")
        if declared.timeout_ns is not None:
            require_duration(declared.timeout_ns, where)
    for index, slot in enumerate(machine.slots):
        where = f"slot {index}"
        require_index(slot.input, len(machine.inputs), where, "input")
        require_finite((slot.scale, slot.offset), where)
        is_plain = (slot.scale, slot.offset) == (1.0, 0.0)
        require(is_plain or slot.kind is FieldKind.REAL, where, f"a scaled {slot.kind.value}")
        is_number = slot.limits is None or slot.kind is FieldKind.REAL
        require(is_number, where, f"limits of a {slot.kind.value}")
        _require_limits(slot.limits, where)
        _verify_query(slot, where)
    for index, array in enumerate(machine.arrays):
        where = f"array {index}"
        require_index(array.input, len(machine.inputs), where, "input")
        require_finite((array.scale, array.offset), where)
        _require_limits(array.limits, where)
        require(not _asks_skills(array.path), where, "skills answer with no array")
        _verify_column(machine, array, where)
    for index, each in enumerate(machine.lists):
        where = f"list {index}"
        require_index(each.input, len(machine.inputs), where, "input")
        require(each.most >= 1, where, f"at most {each.most} elements")
        require(bool(columns_of(machine, index)), where, "no columns")


def _verify_query(slot: ir.Slot, where: str) -> None:
    """Require that a query about running skills applies to the message itself."""
    match slot.path:
        case (Doing(skills=skills, arguments=arguments),):
            require(slot.kind is FieldKind.FLAG, where, f"an answer of the kind {slot.kind.value}")
            choices = [skills, *(classes for _, classes in arguments)]
            require(all(map(_is_choice, choices)), where, "names that are not sorted, or none")
            parameters = tuple(parameter for parameter, _ in arguments)
            require(parameters == tuple(sorted(set(parameters))), where, "unsorted parameters")
        case (Quantity(skills=skills, is_boolean=is_boolean),):
            kind = FieldKind.FLAG if is_boolean else FieldKind.REAL
            require(slot.kind is kind, where, f"a quantity of the kind {slot.kind.value}")
            require(_is_choice(skills), where, "names that are not sorted, or none")
        case _:  # open: other paths contain no query about skills
            require(not _asks_skills(slot.path), where, "a query to skills inside a message")


def _asks_skills(path: Path) -> bool:
    return any(isinstance(step, Doing | Quantity) for step in path)


def _is_choice(names: tuple[str, ...]) -> bool:
    return bool(names) and names == tuple(sorted(set(names)))


def _verify_column(machine: ir.Machine, array: ir.Array, where: str) -> None:
    """Require that a column belongs to the input of its list, and leads through each element."""
    if array.list is None:
        require(array.kind is FieldKind.REAL, where, f"an array of the kind {array.kind.value}")
        require(EACH not in array.path, where, "a field of each element, but of no list")
        return
    require(array.kind is not FieldKind.FLAG, where, "flags are numbers within limits")
    require_index(array.list, len(machine.lists), where, "list")
    its_list = machine.lists[array.list]
    require(array.input == its_list.input, where, "another input than that of its list")
    length = len(its_list.path)
    is_inside = array.path[: length + 1] == (*its_list.path, EACH)
    require(is_inside and EACH not in array.path[length + 1 :], where, "a path beside its list")
    is_plain = (array.scale, array.offset, array.limits) == (1.0, 0.0, None)
    require(is_plain or array.kind is FieldKind.REAL, where, f"a scaled {array.kind.value}")


def _require_limits(limits: tuple[float, float] | None, where: str) -> None:
    if limits is not None:
        require_finite(limits, where)
        require(limits[0] <= limits[1], where, f"limits from {limits[0]} to {limits[1]}")
        require(all(end.is_integer() for end in limits), where, "limits that are not whole")


# --- nodes -----------------------------------------------------------------------------------


def _verify_signals(machine: ir.Machine) -> None:
    for index, signal in enumerate(machine.signals):
        where = f"signal {index} ({type(signal.node).__name__})"
        _require_before(signal_operands(signal.node), index, where)
        require_finite((signal.scale, signal.offset), where)
        match signal.node:
            case ir.Constant(value=value):
                require_finite((value,), where)
            case ir.Read(slot=slot):
                require_index(slot, len(machine.slots), where, "slot")
            case ir.Element(array=array):
                require_index(array, len(machine.arrays), where, "array")
            case ir.Count(element=element):
                require_index(element, len(machine.propositions), where, "proposition")
            case ir.Apply(function=function, operands=operands):
                is_right = row(function).takes(len(operands))
                require(is_right, where, f"{function.value} of {len(operands)} operands")
                if function in (Function.RAISED, Function.LOWERED):
                    is_setting = setting_numbers(machine, signal.node) is not None
                    require(is_setting, where, "a parameter of the node that is none")
            case ir.Sampled(function=function, window_ns=window_ns):
                if sampling_row(function).takes_time:
                    require_duration(window_ns, where)
                else:
                    require(window_ns == 0, where, "a time that it does not take")
            case ir.Fold():
                pass


def _verify_propositions(machine: ir.Machine) -> None:
    for index, proposition in enumerate(machine.propositions):
        where = f"proposition {index} ({type(proposition.node).__name__})"
        _require_before(proposition_operands(proposition.node), index, where)
        for signal in compared_signals(proposition.node):
            require_index(signal, len(machine.signals), where, "signal")
        _verify_proposition(machine, proposition.node, where)


def _verify_proposition(machine: ir.Machine, node: ir.PropositionNode, where: str) -> None:
    match node:
        case ir.And(operands=operands) | ir.Or(operands=operands):
            require(len(operands) >= 2, where, f"{len(operands)} operands")
        case ir.Held(duration_ns=duration_ns):
            require_duration(duration_ns, where)
        case ir.Recurs(count=count, window_ns=window_ns):
            require(count >= 1, where, f"{count} edges")
            require_duration(window_ns, where)
        case ir.AgeReaches(input=used, age_ns=age_ns):
            require_index(used, len(machine.inputs), where, "input")
            require_duration(age_ns, where)
        case ir.Oscillates(count=count, window_ns=window_ns, swing=swing):
            require(count >= 1, where, f"{count} turning points")
            require_duration(window_ns, where)
            require_finite((swing,), where)
            require(swing >= 0.0, where, f"a swing of {swing}")
        case (
            ir.Literal() | ir.Compare() | ir.Between() | ir.Flag() | ir.Quantified() | ir.Not()
            | ir.Since()
        ):  # fmt: skip
            pass


# --- elements --------------------------------------------------------------------------------


def _verified_arrays(machine: ir.Machine) -> ElementArrays:
    try:
        return element_arrays(machine)
    except ValueError as error:
        raise MalformedMachine(f"elementwise: {error}") from error


def _verify_counts(machine: ir.Machine) -> None:
    """Require that the signals below a counted proposition come before the count."""
    for index, signal in enumerate(machine.signals):
        if isinstance(signal.node, ir.Count):
            where = f"signal {index} (Count)"
            for each in _element_propositions(machine, signal.node.element):
                _require_before(compared_signals(machine.propositions[each].node), index, where)


def _element_propositions(machine: ir.Machine, top: int) -> tuple[int, ...]:
    return (top, *(each for each in reachable_propositions(machine, top) if each != top))


def _verify_element_use(machine: ir.Machine, arrays: ElementArrays) -> None:
    may_stand = stand_beside(machine)
    for index, signal in enumerate(machine.signals):
        where = f"signal {index} ({type(signal.node).__name__})"
        operands = signal_operands(signal.node)
        match signal.node:
            case ir.Fold(element=element):
                require(arrays.signals[element] is not None, where, "folds no elements")
            case ir.Count(element=element):
                require(arrays.propositions[element] is not None, where, "counts no elements")
            case ir.Sampled():
                _require_whole(operands, arrays.signals, where)
            case ir.Constant() | ir.Read() | ir.Element() | ir.Apply():
                if arrays.signals[index] is not None:
                    _require_element_signals(operands, arrays, may_stand, where)
    for index, proposition in enumerate(machine.propositions):
        where = f"proposition {index} ({type(proposition.node).__name__})"
        operands = proposition_operands(proposition.node)
        if isinstance(proposition.node, ir.Quantified):
            require(arrays.propositions[operands[0]] is not None, where, "quantifies no elements")
        elif arrays.propositions[index] is None:
            _require_whole(operands, arrays.propositions, where)
            _require_whole(compared_signals(proposition.node), arrays.signals, where)
        else:
            _require_element_signals(compared_signals(proposition.node), arrays, may_stand, where)
            _require_element_propositions(machine, operands, arrays, where)


def _require_whole(operands: Iterable[int], arrays: tuple[int | None, ...], where: str) -> None:
    for operand in operands:
        require(arrays[operand] is None, where, f"operand {operand} is elementwise")


def _require_element_signals(
    operands: Iterable[int], arrays: ElementArrays, may_stand: Sequence[bool], where: str
) -> None:
    for operand in operands:
        is_element = arrays.signals[operand] is not None
        message = f"operand {operand} is neither elementwise nor of slots and constants"
        require(is_element or may_stand[operand], where, message)


def _require_element_propositions(
    machine: ir.Machine, operands: Iterable[int], arrays: ElementArrays, where: str
) -> None:
    for operand in operands:
        is_constant = isinstance(machine.propositions[operand].node, ir.Literal)
        is_element = arrays.propositions[operand] is not None
        require(is_constant or is_element, where, f"operand {operand} is not elementwise")


# --- kinds -----------------------------------------------------------------------------------


def _verify_kinds(machine: ir.Machine) -> None:
    """Require that flags are tested or compared with flags, and that texts and frames are compared
    for equality.
    """
    for index, signal in enumerate(machine.signals):
        where = f"signal {index} ({type(signal.node).__name__})"
        for operand in signal_operands(signal.node):
            kind = kind_of(machine, operand)
            if operand in _frames_of(machine, signal.node, where):
                continue
            is_right = kind is FieldKind.REAL or (kind is FieldKind.FLAG and _keeps(signal.node))
            require(is_right, where, f"operand {operand} is a {kind.value}")
    for index, node in enumerate(each.node for each in machine.propositions):
        where = f"proposition {index} ({type(node).__name__})"
        if isinstance(node, ir.Flag):
            kind = kind_of(machine, node.signal)
            is_element = isinstance(machine.signals[node.signal].node, ir.Element)
            is_flag = kind is FieldKind.FLAG or (is_element and kind is FieldKind.REAL)
            require(is_flag, where, f"tests a {kind.value}")
        elif not (_compares_text(machine, node) or _compares_flags(machine, node)):
            for operand in compared_signals(node):
                kind = kind_of(machine, operand)
                require(kind is FieldKind.REAL, where, f"operand {operand} is a {kind.value}")


def _frames_of(machine: ir.Machine, node: ir.SignalNode, where: str) -> tuple[int, ...]:
    """The operands that are texts: the frame of a point, and the frame of a region."""
    match node:
        case ir.Apply(function=RegionFunction(), operands=(_, _, seen, wanted)):
            pass
        case ir.Apply(function=Function.SEEN, operands=(_, seen, wanted)) if (
            kind_of(machine, seen) is FieldKind.TEXT
        ):
            pass
        case _:  # open: no other function compares texts
            return ()
    is_reported = kind_of(machine, seen) is FieldKind.TEXT
    require(is_reported or _is_literal(machine, seen), where, "a frame that is no text")
    require(_is_literal(machine, wanted), where, "the wanted frame is no text")
    return (seen, wanted)


def _is_literal(machine: ir.Machine, signal: int) -> bool:
    """Say whether a signal is a text of the rules."""
    node = machine.signals[signal].node
    return isinstance(node, ir.Constant) and node.value in range(len(machine.texts))


def _keeps(node: ir.SignalNode) -> bool:
    return isinstance(node, ir.Sampled) and sampling_row(node.function).gives_a_sample


def _compares_flags(machine: ir.Machine, node: ir.PropositionNode) -> bool:
    if not isinstance(node, ir.Compare) or node.comparison not in _EQUALITY:
        return False
    return all(kind_of(machine, side) is FieldKind.FLAG for side in (node.left, node.right))


def _compares_text(machine: ir.Machine, node: ir.PropositionNode) -> bool:
    """Say whether a node compares a text with a literal. All unknown texts have one number."""
    if not isinstance(node, ir.Compare):
        return False
    is_of_text = kind_of(machine, node.left) is FieldKind.TEXT
    return node.comparison in _EQUALITY and is_of_text and _is_literal(machine, node.right)


# --- rules -----------------------------------------------------------------------------------


def _verify_rules(machine: ir.Machine, arrays: ElementArrays) -> None:
    rests_on = supports(machine).propositions
    for index, rule in enumerate(machine.rules):
        where = f"rule {index} ({rule.name})"
        for root in rule.roots:
            require_index(root, len(machine.propositions), where, "proposition")
            is_single = arrays.propositions[root] is None
            require(is_single, where, f"proposition {root} is elementwise")
        require(rule.terms == rule_terms(machine, rule.condition), where, "wrong terms")
        require(rule.signals == rule_signals(machine, rule.condition), where, "wrong signals")
        inputs = tuple(sorted(rests_on[rule.condition].inputs))
        require(rule.inputs == inputs, where, "wrong inputs")
        if rule.feedback.margin is not None:
            _verify_margin(machine, rule.feedback.margin, arrays, where)
        for hazard in rule.hazards:
            require_index(hazard, len(machine.hazards), where, "hazard")
    for name, times in Counter(rule.name for rule in machine.rules).items():
        require(times == 1, f"rule {name}", f"there are {times} of this name")


def _verify_margin(machine: ir.Machine, margin: Margin, arrays: ElementArrays, where: str) -> None:
    require_index(margin.signal, len(machine.signals), where, "signal")
    require(arrays.signals[margin.signal] is None, where, "an elementwise margin")
    require(kind_of(machine, margin.signal) is FieldKind.REAL, where, "a margin that is no number")
    require_finite((margin.scale,), where)
    require(margin.scale > 0.0, where, f"a margin times {margin.scale}")


def _verify_asked(machine: ir.Machine, arrays: ElementArrays) -> None:
    """Require that the signals and propositions that actions use are not elementwise."""
    for index, signal in enumerate(machine.readings):
        where = f"reading {index}"
        require_index(signal, len(machine.signals), where, "signal")
        require(arrays.signals[signal] is None, where, f"signal {signal} is elementwise")
    for index, watched in enumerate(machine.watches):
        where = f"watch {index}"
        require_index(watched, len(machine.propositions), where, "proposition")
        is_single = arrays.propositions[watched] is None
        require(is_single, where, f"proposition {watched} is elementwise")
