"""The support of a signal or a proposition: queries about a machine that every target needs.

The input is a machine whose operands precede their users. Answers never depend on values.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from rossmarie.core import RegionFunction, RegionMeasure, sampling_row
from rossmarie.ir import model as ir


@dataclass(frozen=True)
class Support:
    """All parts of a machine that a value can depend on, as indices.

    `folds` are the signals (`Fold` and `Count`) that turn an array into a number, `samples` the
    signals (`Sampled`) that wait for samples. The input of an `AgeReaches` is among `inputs` even
    if none of its slots is. `beside` are the slots that are read beside elements when these arrive
    (S74). They are among `slots` only if they are also read elsewhere. Their inputs are among
    `inputs`, but their channels, whose messages change nothing, are not among `channels`.
    """

    slots: frozenset[int] = frozenset()
    arrays: frozenset[int] = frozenset()
    folds: frozenset[int] = frozenset()
    samples: frozenset[int] = frozenset()
    inputs: frozenset[int] = frozenset()
    channels: frozenset[int] = frozenset()
    beside: frozenset[int] = frozenset()

    def __or__(self, other: Support) -> Support:
        return Support(
            self.slots | other.slots,
            self.arrays | other.arrays,
            self.folds | other.folds,
            self.samples | other.samples,
            self.inputs | other.inputs,
            self.channels | other.channels,
            self.beside | other.beside,
        )


@dataclass(frozen=True)
class Supports:
    """The support of every signal and every proposition of a machine, by index."""

    signals: tuple[Support, ...]
    propositions: tuple[Support, ...]


def all_channels(machine: ir.Machine, support: Support) -> frozenset[int]:
    """All channels that a value depends on, including the channels of numbers beside elements.
    Messages on these channels alone change nothing.
    """
    return frozenset(machine.inputs[used].channel for used in support.inputs)


def signal_operands(node: ir.SignalNode) -> tuple[int, ...]:
    """The signals that a signal is computed from."""
    match node:
        case ir.Apply(operands=operands):
            return operands
        case ir.Sampled(signal=signal):
            return (signal,)
        case ir.Fold(element=element):
            return (element,)
        case ir.Constant() | ir.Read() | ir.Element() | ir.Count():
            return ()


def proposition_operands(node: ir.PropositionNode) -> tuple[int, ...]:
    """The propositions that a proposition is computed from, elementwise ones included."""
    match node:
        case ir.Not(operand=operand) | ir.Held(operand=operand) | ir.Recurs(operand=operand):
            return (operand,)
        case ir.And(operands=operands) | ir.Or(operands=operands):
            return operands
        case ir.Since(held=held, begun=begun):
            return (held, begun)
        case ir.Quantified(element=element):
            return (element,)
        case (
            ir.Literal() | ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches()
            | ir.Oscillates()
        ):  # fmt: skip
            return ()


def compared_signals(node: ir.PropositionNode) -> tuple[int, ...]:
    """The signals that a leaf proposition compares, in the order of its fields."""
    match node:
        case ir.Compare(left=left, right=right):
            return (left, right)
        case ir.Between(signal=signal, low=low, high=high):
            return (signal, low, high)
        case ir.Flag(signal=signal) | ir.Oscillates(signal=signal):
            return (signal,)
        case (
            ir.Literal() | ir.AgeReaches() | ir.Quantified() | ir.Not() | ir.And() | ir.Or()
            | ir.Held() | ir.Since() | ir.Recurs()
        ):  # fmt: skip
            return ()


def is_leaf(node: ir.PropositionNode) -> bool:
    """Say whether a proposition depends directly on numbers, arrays or ages, not on other
    propositions.
    """
    match node:
        case (
            ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches() | ir.Oscillates()
            | ir.Quantified()
        ):  # fmt: skip
            return True
        case ir.Literal() | ir.Not() | ir.And() | ir.Or() | ir.Held() | ir.Since() | ir.Recurs():
            return False


def supports(machine: ir.Machine) -> Supports:
    """The support of every signal and proposition. An elementwise node depends on its array, and on
    the numbers beside it.
    """
    signals: list[Support] = []
    for index, signal in enumerate(machine.signals):
        signals.append(_signal_support(machine, index, signal.node, signals))
    propositions: list[Support] = []
    for proposition in machine.propositions:
        propositions.append(_proposition_support(machine, proposition.node, signals, propositions))
    return Supports(tuple(signals), tuple(propositions))


def _below_count(machine: ir.Machine, proposition: int, signals: list[Support]) -> Support:
    """The support of a counted proposition: `Count` needs it before the propositions are
    visited.
    """
    node = machine.propositions[proposition].node
    parts = [signals[signal] for signal in compared_signals(node)]
    parts += [_below_count(machine, each, signals) for each in proposition_operands(node)]
    return _union(parts)


def _over_elements(machine: ir.Machine, inner: Support, *folds: int) -> Support:
    """The support of a result over all elements, which is computed when they arrive (S26, S74)."""
    used = {machine.arrays[array].input for array in inner.arrays}
    return Support(
        arrays=inner.arrays,
        folds=frozenset(folds),
        inputs=inner.inputs,
        channels=frozenset(machine.inputs[each].channel for each in used),
        beside=inner.slots,
    )


def _array_support(machine: ir.Machine, array: int) -> Support:
    """The support of an array. All columns of a list arrive and expire together."""
    used = machine.arrays[array].input
    its_list = machine.arrays[array].list
    columns = (array,) if its_list is None else columns_of(machine, its_list)
    return Support(
        arrays=frozenset(columns),
        inputs=frozenset({used}),
        channels=frozenset({machine.inputs[used].channel}),
    )


def _signal_support(
    machine: ir.Machine,
    index: int,
    node: ir.SignalNode,
    signals: list[Support],
) -> Support:
    match node:
        case ir.Read(slot=slot):
            used = machine.slots[slot].input
            return Support(
                slots=frozenset({slot}),
                inputs=frozenset({used}),
                channels=frozenset({machine.inputs[used].channel}),
            )
        case ir.Element(array=array):
            return _array_support(machine, array)
        case ir.Fold(element=element):
            return _over_elements(machine, signals[element], index)
        case ir.Count(element=element):
            return _over_elements(machine, _below_count(machine, element, signals), index)
        case ir.Sampled(function=function, signal=signal):
            waiting = {index} if sampling_row(function).waits else set()
            return signals[signal] | Support(samples=frozenset(waiting))
        case ir.Constant() | ir.Apply():
            return _union(signals[operand] for operand in signal_operands(node))


def _proposition_support(
    machine: ir.Machine,
    node: ir.PropositionNode,
    signals: list[Support],
    propositions: list[Support],
) -> Support:
    match node:
        case ir.AgeReaches(input=used):
            channel = machine.inputs[used].channel
            return Support(inputs=frozenset({used}), channels=frozenset({channel}))
        case ir.Compare() | ir.Between() | ir.Flag() | ir.Oscillates():
            return _union(signals[signal] for signal in compared_signals(node))
        case ir.Quantified(element=element):
            return _over_elements(machine, propositions[element])
        case (
            ir.Literal() | ir.Not() | ir.And() | ir.Or() | ir.Held() | ir.Since() | ir.Recurs()
        ):  # fmt: skip
            return _union(propositions[operand] for operand in proposition_operands(node))


def _union(parts: Iterable[Support]) -> Support:
    whole = Support()
    for part in parts:
        whole = whole | part
    return whole


# --- elements --------------------------------------------------------------------------------


def columns_of(machine: ir.Machine, its_list: int) -> tuple[int, ...]:
    """The arrays that are the columns of a list."""
    return tuple(index for index, array in enumerate(machine.arrays) if array.list == its_list)


def arrays_of(machine: ir.Machine, channel: int) -> tuple[int, ...]:
    """The arrays of a channel in the order in which engines take them: single arrays, then the
    columns of each list.
    """
    alone = [
        index
        for index, array in enumerate(machine.arrays)
        if array.list is None and machine.inputs[array.input].channel == channel
    ]
    lists = [
        index
        for index, each in enumerate(machine.lists)
        if machine.inputs[each.input].channel == channel
    ]
    return (*alone, *(column for each in lists for column in columns_of(machine, each)))


def is_of_list(machine: ir.Machine, support: Support) -> bool:
    """Say whether a value depends on the elements of a list."""
    return any(machine.arrays[array].list is not None for array in support.arrays)


@dataclass(frozen=True)
class ElementArrays:
    """The array of whose elements each signal and proposition uses one, by index; None if it has
    one value for the whole machine. For a list, the array is the first column.
    """

    signals: tuple[int | None, ...]
    propositions: tuple[int | None, ...]


def element_arrays(machine: ir.Machine) -> ElementArrays:
    """The signals and propositions that exist once for each element, with the array of each.

    Raises `ValueError` if a signal or proposition uses elements of two arrays that are not columns
    of one list.
    """
    firsts: dict[int, int] = {}
    for index, array in enumerate(machine.arrays):
        if array.list is not None:
            firsts.setdefault(array.list, index)
    owners = [
        index if array.list is None else firsts[array.list]
        for index, array in enumerate(machine.arrays)
    ]
    signals: list[int | None] = []
    for signal in machine.signals:
        signals.append(_signal_array(signal.node, signals, owners))
    propositions: list[int | None] = []
    for proposition in machine.propositions:
        propositions.append(_proposition_array(proposition.node, signals, propositions))
    return ElementArrays(tuple(signals), tuple(propositions))


def _signal_array(node: ir.SignalNode, signals: list[int | None], owners: list[int]) -> int | None:
    match node:
        case ir.Element(array=array):
            return owners[array]
        case ir.Apply(operands=operands):
            return _single(signals[operand] for operand in operands)
        case ir.Constant() | ir.Read() | ir.Sampled() | ir.Fold() | ir.Count():
            return None


def _proposition_array(
    node: ir.PropositionNode, signals: list[int | None], propositions: list[int | None]
) -> int | None:
    match node:
        case ir.Not() | ir.And() | ir.Or():
            return _single(propositions[operand] for operand in proposition_operands(node))
        case ir.Compare() | ir.Between() | ir.Flag():
            return _single(signals[signal] for signal in compared_signals(node))
        case (
            ir.Literal() | ir.AgeReaches() | ir.Oscillates() | ir.Quantified() | ir.Held()
            | ir.Since() | ir.Recurs()
        ):  # fmt: skip
            return None


def _single(arrays: Iterable[int | None]) -> int | None:
    found = {array for array in arrays if array is not None}
    if len(found) > 1:
        raise ValueError(f"elements of {len(found)} arrays meet")
    return found.pop() if found else None


# --- kinds -----------------------------------------------------------------------------------


def kind_of(machine: ir.Machine, signal: int) -> ir.FieldKind:
    """The kind of a signal's values."""
    match machine.signals[signal].node:
        case ir.Read(slot=slot):
            return machine.slots[slot].kind
        case ir.Sampled(function=function, signal=sampled):
            gives_a_sample = sampling_row(function).gives_a_sample
            return kind_of(machine, sampled) if gives_a_sample else ir.FieldKind.REAL
        case ir.Element(array=array):
            return machine.arrays[array].kind
        case ir.Apply(function=RegionFunction(measure=RegionMeasure.INSIDE)):
            return ir.FieldKind.FLAG
        case ir.Constant() | ir.Apply() | ir.Fold() | ir.Count():
            return ir.FieldKind.REAL


# --- what a rule stands on -------------------------------------------------------------------


def reachable_propositions(machine: ir.Machine, proposition: int) -> tuple[int, ...]:
    """The proposition itself and all its operands, in index order, without elementwise ones."""
    found: set[int] = set()
    waiting = [proposition]
    while waiting:
        index = waiting.pop()
        if index not in found:
            found.add(index)
            waiting.extend(whole_operands(machine.propositions[index].node))
    return tuple(sorted(found))


def whole_operands(node: ir.PropositionNode) -> tuple[int, ...]:
    """The propositions that a proposition is computed from, without elementwise ones."""
    match node:
        case ir.Quantified():
            return ()
        case (
            ir.Literal() | ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches()
            | ir.Oscillates() | ir.Not() | ir.And() | ir.Or() | ir.Held() | ir.Since() | ir.Recurs()
        ):  # fmt: skip
            return proposition_operands(node)


def leaf_propositions(machine: ir.Machine, proposition: int) -> tuple[int, ...]:
    """The leaves that a proposition depends on, in index order."""
    return tuple(
        index
        for index in reachable_propositions(machine, proposition)
        if is_leaf(machine.propositions[index].node)
    )


def rule_signals(machine: ir.Machine, condition: int) -> tuple[int, ...]:
    """The signals in a verdict of a rule with this condition: the signals that its leaves compare,
    without constants, in index order.
    """
    found = {
        signal
        for leaf in leaf_propositions(machine, condition)
        for signal in compared_signals(machine.propositions[leaf].node)
        if not isinstance(machine.signals[signal].node, ir.Constant)
    }
    return tuple(sorted(found))
