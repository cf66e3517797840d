"""The support of a number, a proposition or a rule, computed from the nodes of a machine.

`docs/explanation/semantics.md` uses the support: a message in it recomputes a value (S7), a missing
input in it makes the value unknown (S9) or stale (S30), and a verdict reports it (S41).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeAlias

from rossmarie.core import AnyFunction, Sampling, sampling_row
from rossmarie.ir import model as ir

Node = ir.SignalNode | ir.PropositionNode
Indexes: TypeAlias = tuple[int, ...]


def numbers_of(node: Node) -> tuple[int, ...]:
    """The signals that a node names."""
    match node:
        case ir.Apply(operands=operands):
            return operands
        case ir.Compare(left=left, right=right):
            return left, right
        case ir.Between(signal=signal, low=low, high=high):
            return signal, low, high
        case ir.Sampled(signal=signal) | ir.Flag(signal=signal) | ir.Oscillates(signal=signal):
            return (signal,)
        case ir.Fold(element=element):
            return (element,)
        case (
            ir.Constant() | ir.Read() | ir.Element() | ir.Count() | ir.Literal() | ir.AgeReaches()
            | ir.Quantified() | ir.Not() | ir.And() | ir.Or() | ir.Held() | ir.Since() | ir.Recurs()
        ):  # fmt: skip
            return ()


def propositions_of(node: Node) -> tuple[int, ...]:
    """The propositions that a node names."""
    match node:
        case ir.And(operands=operands) | ir.Or(operands=operands):
            return operands
        case ir.Not(operand=operand) | ir.Held(operand=operand) | ir.Recurs(operand=operand):
            return (operand,)
        case ir.Since(held=held, begun=begun):
            return held, begun
        case ir.Count(element=element) | ir.Quantified(element=element):
            return (element,)
        case (
            ir.Constant() | ir.Read() | ir.Apply() | ir.Sampled() | ir.Element() | ir.Fold()
            | ir.Literal() | ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches()
            | ir.Oscillates()
        ):  # fmt: skip
            return ()


@dataclass(frozen=True)
class Below:
    """Signals and propositions with all their operands, including those of elements of arrays."""

    signals: tuple[int, ...]
    propositions: tuple[int, ...]


def below(machine: ir.Machine, signals: tuple[int, ...], propositions: tuple[int, ...]) -> Below:
    """These signals and propositions, and all their operands, each in order of index."""
    return _below(machine, signals, propositions, ends=())


def _below(
    machine: ir.Machine,
    signals: tuple[int, ...],
    propositions: tuple[int, ...],
    ends: tuple[type[Node], ...],
) -> Below:
    """The same, without the operands of nodes of the kinds `ends`."""
    found_signals, found_propositions = set(signals), set(propositions)
    waiting: list[Node] = [machine.signals[index].node for index in signals]
    waiting += [machine.propositions[index].node for index in propositions]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ends):
            continue
        for index in set(numbers_of(node)) - found_signals:
            found_signals.add(index)
            waiting.append(machine.signals[index].node)
        for index in set(propositions_of(node)) - found_propositions:
            found_propositions.add(index)
            waiting.append(machine.propositions[index].node)
    return Below(tuple(sorted(found_signals)), tuple(sorted(found_propositions)))


@dataclass(frozen=True)
class Support:
    """The parts on which a value can depend, as indexes into the machine. `folds` are signals over
    arrays; `sampled` are signals of samples; `waiting` are unknown until there are enough samples.
    A value is unknown without its `needed` inputs. These are all `inputs` except those of numbers
    beside elements (S74): such numbers are read only when the elements arrive, so their slots and
    channels are left out.
    """

    slots: frozenset[int]
    folds: frozenset[int]
    sampled: frozenset[int]
    waiting: frozenset[int]
    inputs: frozenset[int]
    needed: frozenset[int]
    channels: frozenset[int]


def support(machine: ir.Machine, signals: Indexes, propositions: Indexes) -> Support:
    """The support of some signals and propositions."""
    made_of = _outside_elements(machine, signals, propositions)
    slots: set[int] = set()
    folds: set[int] = set()
    sampled: set[int] = set()
    needed: set[int] = set()
    for index in made_of.signals:
        match machine.signals[index].node:
            case ir.Read(slot=slot):
                slots.add(slot)
                needed.add(machine.slots[slot].input)
            case ir.Fold() | ir.Count():
                folds.add(index)
            case ir.Sampled():
                sampled.add(index)
            case ir.Element(array=array):
                needed.add(machine.arrays[array].input)
            case ir.Constant() | ir.Apply():
                pass
    for index in made_of.propositions:
        node = machine.propositions[index].node
        if isinstance(node, ir.AgeReaches):
            needed.add(node.input)
    inside = list(_inside_elements(machine, made_of))
    needed |= {used for each in inside for used in _of_elements(machine, each)}
    beside_elements = {used for each in inside for used in _of_slots(machine, each)}
    return Support(
        slots=frozenset(slots),
        folds=frozenset(folds),
        sampled=frozenset(sampled),
        waiting=frozenset(index for index in sampled if _waits(machine.signals[index].node)),
        inputs=frozenset(needed | beside_elements),
        needed=frozenset(needed),
        channels=frozenset(machine.inputs[used].channel for used in needed),
    )


def _of_elements(machine: ir.Machine, made_of: Below) -> Iterator[int]:
    """The inputs of the arrays that signals read."""
    for index in made_of.signals:
        node = machine.signals[index].node
        if isinstance(node, ir.Element):
            yield machine.arrays[node.array].input


def _of_slots(machine: ir.Machine, made_of: Below) -> Iterator[int]:
    """The inputs of the slots that signals read."""
    for index in made_of.signals:
        node = machine.signals[index].node
        if isinstance(node, ir.Read):
            yield machine.slots[node.slot].input


def _outside_elements(machine: ir.Machine, signals: Indexes, propositions: Indexes) -> Below:
    """The operands of these, without the operands of results over elements."""
    return _below(machine, signals, propositions, ends=(ir.Fold, ir.Count, ir.Quantified))


def _inside_elements(machine: ir.Machine, made_of: Below) -> Iterator[Below]:
    """All operands of each result over elements, including numbers beside the elements."""
    nodes: list[Node] = [machine.signals[index].node for index in made_of.signals]
    nodes += [machine.propositions[index].node for index in made_of.propositions]
    for node in nodes:
        match node:
            case ir.Fold(element=element):
                yield below(machine, (element,), ())
            case ir.Count(element=element) | ir.Quantified(element=element):
                yield below(machine, (), (element,))
            case _:  # open: no other node is a result over all elements
                pass


def is_of_list(machine: ir.Machine, signal: int) -> bool:
    """Say whether a signal depends on the elements of a list."""
    nodes = (machine.signals[each].node for each in below(machine, (signal,), ()).signals)
    return any(
        isinstance(node, ir.Element) and machine.arrays[node.array].list is not None
        for node in nodes
    )


def of_slot(machine: ir.Machine, slot: int) -> Support:
    """The support of a slot: its input."""
    used = machine.slots[slot].input
    channel = machine.inputs[used].channel
    none: frozenset[int] = frozenset()
    its_input, its_channel = frozenset({used}), frozenset({channel})
    return Support(frozenset({slot}), none, none, none, its_input, its_input, its_channel)


def _waits(node: ir.SignalNode) -> bool:
    return isinstance(node, ir.Sampled) and sampling_row(node.function).waits


# --- elements of arrays ----------------------------------------------------------------------


@dataclass(frozen=True)
class SupportArrays:
    """For each signal and proposition, the array of its element; None if it has one value for the
    whole machine (S22). For a list (S52), the array is its first column.
    """

    signals: tuple[int | None, ...]
    propositions: tuple[int | None, ...]


def elements(machine: ir.Machine) -> SupportArrays:
    """The array of each signal and proposition."""
    signals: list[int | None] = []
    propositions: list[int | None] = []
    for signal in machine.signals:
        signals.append(_array(machine, signal.node, signals, propositions))
    for proposition in machine.propositions:
        propositions.append(_array(machine, proposition.node, signals, propositions))
    return SupportArrays(tuple(signals), tuple(propositions))


def columns(machine: ir.Machine, array: int) -> tuple[int, ...]:
    """An array that belongs to no list, or all columns of the list that the array belongs to."""
    its_list = machine.arrays[array].list
    if its_list is None:
        return (array,)
    return tuple(index for index, each in enumerate(machine.arrays) if each.list == its_list)


def _array(
    machine: ir.Machine, node: Node, signals: list[int | None], propositions: list[int | None]
) -> int | None:
    match node:
        case ir.Element(array=array):
            return columns(machine, array)[0]
        case (
            ir.Apply() | ir.Compare() | ir.Between() | ir.Flag() | ir.Not() | ir.And() | ir.Or()
        ):  # fmt: skip
            named = [signals[index] for index in numbers_of(node)]
            named += [propositions[index] for index in propositions_of(node)]
            return next((array for array in named if array is not None), None)
        case (
            ir.Constant() | ir.Read() | ir.Sampled() | ir.Fold() | ir.Count() | ir.Literal()
            | ir.AgeReaches() | ir.Oscillates() | ir.Quantified() | ir.Held() | ir.Since()
            | ir.Recurs()
        ):  # fmt: skip
            return None


@dataclass(frozen=True)
class Beside:
    """The numbers beside elements (S74). `arrays` are the first columns of the arrays whose
    elements are used with such numbers (not constants); `signals` are computed before.
    """

    arrays: frozenset[int]
    signals: frozenset[int]


def beside(machine: ir.Machine) -> Beside:
    """The numbers beside elements of a machine."""
    its = elements(machine)
    arrays, found = set[int](), set[int]()
    nodes: list[tuple[int | None, Node]] = [
        (array, machine.signals[index].node) for index, array in enumerate(its.signals)
    ]
    nodes += zip(its.propositions, (each.node for each in machine.propositions), strict=True)
    for array, node in nodes:
        for signal in numbers_of(node):
            is_constant = isinstance(machine.signals[signal].node, ir.Constant)
            if array is not None and its.signals[signal] is None and not is_constant:
                arrays.add(array)
                found.add(signal)
    made_of = below(machine, tuple(sorted(found)), ()).signals
    computed = {index for index in made_of if isinstance(machine.signals[index].node, ir.Apply)}
    heard = {index for index in computed if support(machine, (index,), ()).channels}
    return Beside(frozenset(arrays), frozenset(heard))


# --- rules -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Reported:
    """The propositions, signals of leaves, and inputs in a verdict of a rule."""

    terms: tuple[int, ...]
    signals: tuple[int, ...]
    inputs: tuple[int, ...]


def reported(machine: ir.Machine, condition: int) -> Reported:
    """S41: the named, leaf and timed conditions of a rule, its signals and its inputs."""
    whole = _whole(machine, condition)
    leaves = [index for index in whole if is_leaf(machine.propositions[index].node)]
    over_time = [index for index in whole if _is_over_time(machine, index)]
    looked_at = {index for leaf in leaves for index in numbers_of(machine.propositions[leaf].node)}
    return Reported(
        terms=tuple(
            index
            for index in whole
            if index in leaves or index in over_time or machine.propositions[index].name is not None
        ),
        signals=tuple(
            index
            for index in sorted(looked_at)
            if not isinstance(machine.signals[index].node, ir.Constant)
        ),
        inputs=tuple(sorted(support(machine, (), (condition,)).inputs)),
    )


def _whole(machine: ir.Machine, condition: int) -> list[int]:
    """A proposition and its operands, without results over elements of arrays. Of a condition that
    is defined by other conditions (S45, S46), it includes only those that the user names.
    """
    found, waiting = {condition}, [condition]
    while waiting:
        index = waiting.pop()
        node = machine.propositions[index].node
        if not isinstance(node, ir.Quantified):
            named = _named_by(machine, index)
            new = set(propositions_of(node) if named is None else named) - found
            found |= new
            waiting += new
    return sorted(found)


def _is_over_time(machine: ir.Machine, proposition: int) -> bool:
    node = machine.propositions[proposition].node
    is_timed = isinstance(node, ir.Held | ir.Since | ir.Recurs)
    return is_timed or _named_by(machine, proposition) is not None


def _named_by(machine: ir.Machine, proposition: int) -> tuple[int, ...] | None:
    """The conditions that the user names in a `once` (S45) or `after` (S46)."""
    nodes = [each.node for each in machine.propositions]
    match nodes[proposition]:
        case ir.Not(operand=held) if isinstance(lasting := nodes[held], ir.Held):
            inner = nodes[lasting.operand]
        case _:  # open: not the `not` of a `for`
            return None
    if isinstance(inner, ir.Not) and lasting.initially:
        return (inner.operand,)
    if not isinstance(inner, ir.Since) or lasting.initially:
        return None
    missing, begun = nodes[inner.held], nodes[inner.begun]
    if not isinstance(missing, ir.Not):
        return None
    if inner.begun == inner.held:
        return inner.begun, missing.operand
    is_both = isinstance(begun, ir.And) and begun.operands[1:] == (inner.held,)
    return (begun.operands[0], missing.operand) if isinstance(begun, ir.And) and is_both else None


def is_leaf(node: ir.PropositionNode) -> bool:
    """Say whether a proposition reads numbers, arrays or ages directly (S30)."""
    match node:
        case ir.Literal() | ir.Not() | ir.And() | ir.Or() | ir.Held() | ir.Since() | ir.Recurs():
            return False
        case (
            ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches() | ir.Oscillates()
            | ir.Quantified()
        ):  # fmt: skip
            return True


# --- functions -------------------------------------------------------------------------------


def functions(machine: ir.Machine) -> tuple[tuple[AnyFunction, int], ...]:
    """The functions that signals apply, each with its number of operands."""
    found: dict[tuple[AnyFunction, int], None] = {}
    for signal in machine.signals:
        match signal.node:
            case ir.Apply(function=function, operands=operands):
                found[function, len(operands)] = None
            case ir.Fold(folding=folding):
                found[folding.function, 2] = None
            case (
                ir.Constant() | ir.Read() | ir.Sampled() | ir.Element() | ir.Count()
            ):  # fmt: skip
                pass
    return tuple(found)


def samplings(machine: ir.Machine) -> tuple[Sampling, ...]:
    """The functions of samples among the signals."""
    nodes = (signal.node for signal in machine.signals)
    return tuple(dict.fromkeys(node.function for node in nodes if isinstance(node, ir.Sampled)))
