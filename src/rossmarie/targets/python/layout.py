"""The places of all parts of a machine in the generated Python.

The input is a machine that `ir.verify` has accepted. Names contain the index in the machine: slots
are `x0`, computed signals `s0`, propositions `t0` (since `d0`). Inputs of one channel with one
timeout share a state, because they arrive and expire together. A *guard* is a gap between two
limits of a number. Inside the gap, no comparison of the number with constants changes.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

from rossmarie import ir
from rossmarie.core import sampling_row
from rossmarie.targets.limits import limits_of


@dataclass(frozen=True)
class InputGroup:
    """The inputs of a channel that have the same timeout."""

    state: str
    channel: int
    timeout_ns: int | None
    inputs: frozenset[int]


@dataclass(frozen=True)
class ValueLimits:
    """The limits of a number, from low to high, and the propositions that compare it with them."""

    value: str
    signal: int
    leaves: tuple[int, ...]
    cuts: tuple[float, ...]

    @property
    def low(self) -> str:
        """The variable of the limit below the number."""
        return f"low_{self.value}"

    @property
    def high(self) -> str:
        """The variable of the limit above the number, or equal to it."""
        return f"high_{self.value}"


class PythonLayout:
    """Queries about one machine."""

    def __init__(self, machine: ir.Machine) -> None:
        self.machine = machine
        self.supports = ir.supports(machine)
        self.elements = ir.element_arrays(machine)
        self.signals = [i for i, array in enumerate(self.elements.signals) if array is None]
        self.propositions = [
            i for i, array in enumerate(self.elements.propositions) if array is None
        ]
        self.terms = {term for rule in machine.rules for term in rule.terms}
        self.numbers_beside = ir.beside(machine)
        self.made_beside = ir.made_beside(machine)

    # --- names -------------------------------------------------------------------------------

    def value(self, signal: int) -> str:
        """The expression for a signal: a literal, the slot that it reads, or a variable of its
        own.
        """
        match self.machine.signals[signal].node:
            case ir.Constant(value=value):
                return number(value)
            case ir.Read(slot=slot):
                return f"x{slot}"
            case (
                ir.Apply() | ir.Sampled() | ir.Element() | ir.Fold() | ir.Count()
            ):  # fmt: skip
                return f"s{signal}"

    @cached_property
    def kept(self) -> list[int]:
        """The propositions that are stored: all except literals that no verdict reports."""
        nodes = self.machine.propositions
        return [
            index
            for index in self.propositions
            if index in self.terms or not isinstance(nodes[index].node, ir.Literal)
        ]

    def proposition(self, index: int) -> str:
        """The expression for a proposition: a literal or a variable."""
        node = self.machine.propositions[index].node
        return str(int(node.value)) if isinstance(node, ir.Literal) else f"t{index}"

    # --- inputs ------------------------------------------------------------------------------

    @cached_property
    def groups(self) -> list[InputGroup]:
        """All groups of inputs."""
        members: dict[tuple[int, int | None], set[int]] = {}
        for index, used in enumerate(self.machine.inputs):
            members.setdefault((used.channel, used.timeout_ns), set()).add(index)
        return [
            InputGroup(f"state_{number}", channel, timeout_ns, frozenset(inputs))
            for number, ((channel, timeout_ns), inputs) in enumerate(members.items())
        ]

    @cached_property
    def state_of_input(self) -> dict[int, str]:
        """The state of each input."""
        return {used: group.state for group in self.groups for used in group.inputs}

    @cached_property
    def stamped(self) -> frozenset[int]:
        """The channels whose last instant is used, for a timeout or an age."""
        timed = {group.channel for group in self.groups if group.timeout_ns is not None}
        return frozenset(timed | {self.channel(node.input) for _, node in self.ages})

    def channel(self, used: int) -> int:
        """The channel of an input."""
        return self.machine.inputs[used].channel

    def slots(self, channel: int) -> list[int]:
        """The slots that a channel carries."""
        slots = enumerate(self.machine.slots)
        return [index for index, slot in slots if self.channel(slot.input) == channel]

    def arrays(self, channel: int) -> list[int]:
        """The arrays that a channel carries: first arrays outside of lists, then the columns of
        lists.
        """
        return list(ir.arrays_of(self.machine, channel))

    def beside(self, array: int) -> tuple[int, ...]:
        """The columns of the list that an array belongs to; the array itself if it belongs to no
        list.
        """
        its_list = self.machine.arrays[array].list
        return (array,) if its_list is None else ir.columns_of(self.machine, its_list)

    def is_kept(self, array: int) -> bool:
        """Say whether an array is processed in the evaluation, with numbers beside it (S74)."""
        return self.beside(array)[0] in self.numbers_beside

    def is_timed(self, inputs: Iterable[int]) -> bool:
        """Say whether any of the inputs expires."""
        return any(self.machine.inputs[used].timeout_ns is not None for used in inputs)

    # --- memories ----------------------------------------------------------------------------

    @cached_property
    def ages(self) -> list[tuple[int, ir.AgeReaches]]:
        """The propositions about the age of an input."""
        nodes = ((index, self.machine.propositions[index].node) for index in self.propositions)
        return [(index, node) for index, node in nodes if isinstance(node, ir.AgeReaches)]

    @cached_property
    def held(self) -> list[tuple[int, ir.Held]]:
        """The propositions with `for`."""
        nodes = ((index, self.machine.propositions[index].node) for index in self.propositions)
        return [(index, node) for index, node in nodes if isinstance(node, ir.Held)]

    @cached_property
    def sinces(self) -> list[int]:
        """The propositions with `since`, which remember their last value."""
        return [
            i for i in self.propositions if isinstance(self.machine.propositions[i].node, ir.Since)
        ]

    @cached_property
    def oscillations(self) -> list[tuple[int, ir.Oscillates]]:
        """The oscillations of signals that depend on an input; other oscillations never swing."""
        nodes = ((index, self.machine.propositions[index].node) for index in self.propositions)
        return [
            (index, node)
            for index, node in nodes
            if isinstance(node, ir.Oscillates) and self.supports.signals[node.signal].channels
        ]

    @cached_property
    def recurring(self) -> list[tuple[int, ir.Recurs]]:
        """The propositions that count edges."""
        nodes = ((index, self.machine.propositions[index].node) for index in self.propositions)
        return [(index, node) for index, node in nodes if isinstance(node, ir.Recurs)]

    @cached_property
    def memories(self) -> dict[str, ir.Sampled]:
        """The names of the memories of samples, each with a node that uses it. The sampled signals
        depend on an input.
        """
        found: dict[str, ir.Sampled] = {}
        for signal in self.machine.signals:
            if isinstance(signal.node, ir.Sampled) and self._channels(signal.node.signal):
                found.setdefault(memory(signal.node), signal.node)
        return found

    @property
    def sampled(self) -> list[int]:
        """The signals whose samples are remembered."""
        return sorted({node.signal for node in self.memories.values()})

    def _channels(self, signal: int) -> frozenset[int]:
        return self.supports.signals[signal].channels

    # --- guards ------------------------------------------------------------------------------

    @cached_property
    def guards(self) -> list[ValueLimits]:
        """The guards of all numbers that depend only on slots; such numbers are never infinite."""
        leaves: dict[str, list[int]] = {}
        cuts: dict[str, set[float]] = {}
        signals: dict[str, int] = {}
        for index in self.propositions:
            limited = limits_of(self.machine, self.machine.propositions[index].node)
            if limited is None or self._is_remembered(limited.signal):
                continue
            value = self.value(limited.signal)
            signals.setdefault(value, limited.signal)
            leaves.setdefault(value, []).append(index)
            cuts.setdefault(value, set()).update(
                limit.at for limit in limited.limits if -math.inf < limit.at < sys.float_info.max
            )
        return [
            ValueLimits(value, signal, tuple(leaves[value]), tuple(sorted(cuts[value])))
            for value, signal in signals.items()
        ]

    @cached_property
    def guard_of(self) -> dict[str, ValueLimits]:
        """The guard of each guarded number."""
        return {guard.value: guard for guard in self.guards}

    @cached_property
    def guarded(self) -> frozenset[int]:
        """The propositions that belong to a guard."""
        return frozenset(leaf for guard in self.guards for leaf in guard.leaves)

    def _is_remembered(self, signal: int) -> bool:
        support = self.supports.signals[signal]
        return bool(support.folds or support.samples)


def memory(node: ir.Sampled) -> str:
    """The name of the memory with the samples that a node uses, or with the node's own results."""
    kept = "results" if sampling_row(node.function).feeds_back else "samples"
    time = f"_{node.window_ns}" if node.window_ns else ""
    return f"{kept}_{node.signal}{time}"


def number(value: float) -> str:
    """A finite number as an expression that gives the same bits."""
    text = repr(value)
    return f"({text})" if math.copysign(1.0, value) < 0 else text
