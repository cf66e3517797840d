"""The places of all parts of a machine in the generated C.

The input is a machine that `ir.verify` has passed. The result is the numbers and names of all
parts:

- *values* are the doubles that a monitor keeps: slots, computed signals, and *tests*, which are the
comparisons that have no fixed limits, as numbers (0, 1 or NaN);
- *literals* are the propositions that never change;
- a *guard* watches one value and owns the *leaves* that compare it with limits;
- *nodes* are the propositions, leaves first, followed by the rules; each node follows its operands.
  Oscillations are no leaves here: they are evaluated when marked, as derived propositions are.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from rossmarie import ir
from rossmarie.core import sampling_row
from rossmarie.naming import public_prefix
from rossmarie.targets.c99 import names
from rossmarie.targets.limits import PropositionLimit, limits_of


@dataclass(frozen=True)
class Value:
    """A number that a monitor keeps. Exactly one of the three indexes is set."""

    name: str
    remark: str
    support: ir.Support
    slot: int | None = None
    signal: int | None = None
    test: int | None = None


@dataclass
class ValueGuard:
    """The guard that watches a value; `leaves` are proposition indexes in the order of their
    nodes.
    """

    name: str
    value: int
    leaves: list[int] = field(default_factory=list)
    limits: list[PropositionLimit] = field(default_factory=list)


class SampleWindow(NamedTuple):
    """The samples of a signal within the last `length_ns`, in ns."""

    signal: int
    length_ns: int


@dataclass(frozen=True)
class CLayout:
    """The layout of one machine. Lists of proposition indexes are in the order of their nodes."""

    machine: ir.Machine
    name: str
    supports: ir.Supports
    elements: ir.ElementArrays
    values: tuple[Value, ...]
    value_of_slot: tuple[int, ...]
    value_of_signal: dict[int, int]
    value_of_test: dict[int, int]
    guards: tuple[ValueGuard, ...]
    literals: tuple[int, ...]
    ages: tuple[int, ...]
    oscillations: tuple[int, ...]
    recurring: tuple[int, ...]
    derived: tuple[int, ...]
    held: tuple[int, ...]
    sinces: tuple[int, ...]
    sampled: tuple[int, ...]
    windows: tuple[SampleWindow, ...]
    node_of_proposition: dict[int, int]
    proposition_names: dict[int, str]
    rule_names: tuple[str, ...]
    channel_names: tuple[str, ...]
    input_names: tuple[str, ...]

    @property
    def recent(self) -> tuple[int, ...]:
        """The propositions that count turning points or edges, in the order in which the monitor
        stores these.
        """
        return (*self.oscillations, *self.recurring)

    @property
    def leaf_count(self) -> int:
        """The number of propositions that are set directly when a number or an age is tested. They
        are never marked.
        """
        return len(self.node_of_proposition) - len(self.oscillations) - len(self.derived)

    @property
    def proposition_count(self) -> int:
        """The number of propositions that a monitor keeps."""
        return len(self.node_of_proposition)

    @property
    def held_initially(self) -> list[bool]:
        """For each `for` proposition, whether it counts as true before the start."""
        nodes = (self.machine.propositions[index].node for index in self.held)
        return [node.initially for node in nodes if isinstance(node, ir.Held)]

    def aged_inputs(self) -> set[int]:
        """The inputs whose age a proposition uses."""
        nodes = (self.machine.propositions[index].node for index in self.ages)
        return {node.input for node in nodes if isinstance(node, ir.AgeReaches)}

    def remark(self, proposition: int) -> str:
        """The place and the text of a proposition, for a comment."""
        declared = self.machine.propositions[proposition]
        return f"{names.place(declared.span)}  {declared.text}"

    def propositions_in_order(self) -> list[int]:
        """All proposition indexes in the order of their nodes."""
        return sorted(self.node_of_proposition, key=self.node_of_proposition.__getitem__)

    def has_timeout(self, used: int) -> bool:
        """Say whether an input expires."""
        return self.machine.inputs[used].timeout_ns is not None

    def value_index(self, signal: int) -> int | None:
        """The index of the value of a signal; None for a constant."""
        return self.value_of_signal.get(signal)

    def guards_of(self, channel: int) -> list[ValueGuard]:
        """The guards that a message on a channel can make a number leave."""
        return [g for g in self.guards if channel in self.values[g.value].support.channels]

    def blamed(self, support: ir.Support) -> list[int]:
        """The values whose NaN means that a result is unknown because an input with a timeout is
        missing (S30).
        """
        slots = [
            index
            for index, value in enumerate(self.values)
            if value.slot is not None
            and value.slot in support.slots
            and self.has_timeout(self.machine.slots[value.slot].input)
        ]
        folds = [
            self.value_of_signal[fold]
            for fold in sorted(support.folds)
            if any(map(self.has_timeout, self.supports.signals[fold].inputs))
        ]
        return slots + folds

    def excuses(self, support: ir.Support) -> list[int]:
        """The values that make a result unknown instead of stale if they are missing or infinite
        (S30): slots of inputs without a timeout, folds and samples.
        """
        slots = [
            index
            for index, value in enumerate(self.values)
            if value.slot is not None
            and value.slot in support.slots
            and not self.has_timeout(self.machine.slots[value.slot].input)
        ]
        signals = sorted(support.folds | support.samples)
        return slots + [self.value_of_signal[signal] for signal in signals]

    def is_of_list(self, value: int) -> bool:
        """Say whether a value is a fold over a list, or a sample that depends on such a fold."""
        found = self.values[value]
        return found.slot is None and ir.is_of_list(self.machine, found.support)

    def guard_blames(self, guard: ValueGuard) -> list[int]:
        """The values that make the leaves of a guard stale (S30). A quantifier is stale whenever
        its array is unknown.
        """
        value = self.values[guard.value]
        if value.test is not None:
            node = self.machine.propositions[value.test].node
            if isinstance(node, ir.Quantified):
                stale = any(map(self.has_timeout, value.support.inputs))
                return [guard.value] if stale else []
        return self.blamed(value.support)


def lay_out(machine: ir.Machine) -> CLayout:
    """Number and name every part of a machine."""
    return _Builder(machine).layout()


class _Builder:
    """Collects the parts of a layout in the order in which they are numbered."""

    def __init__(self, machine: ir.Machine) -> None:
        self.machine = machine
        self.supports = ir.supports(machine)
        self.elements = ir.element_arrays(machine)
        self.values: list[Value] = []
        self.value_of_signal: dict[int, int] = {}
        self.value_of_test: dict[int, int] = {}
        self.guards: dict[int, ValueGuard] = {}
        self.family = names.Family("VALUE_")
        self.guard_family = names.Family("GUARD_")
        self.proposition_family = names.Family("PROPOSITION_")
        self.whole = [i for i, a in enumerate(self.elements.propositions) if a is None]

    def layout(self) -> CLayout:
        self._slots()
        self._signals()
        for index in self.whole:
            self._leaf(index)
        guards = tuple(sorted(self.guards.values(), key=lambda guard: guard.value))
        for guard in guards:
            _sort(guard)
        swinging = self._of(ir.Oscillates)
        oscillations = tuple(i for i in swinging if not self._is_still(i))
        literals = (*self._of(ir.Literal), *(i for i in swinging if self._is_still(i)))
        ages = self._of(ir.AgeReaches)
        derived = self._of(ir.Not, ir.And, ir.Or, ir.Held, ir.Since, ir.Recurs)
        guarded = [leaf for guard in guards for leaf in guard.leaves]
        order = [*guarded, *ages, *literals, *oscillations, *derived]
        return CLayout(
            machine=self.machine,
            name=public_prefix(self.machine.name),
            supports=self.supports,
            elements=self.elements,
            values=tuple(self.values),
            value_of_slot=tuple(range(len(self.machine.slots))),
            value_of_signal=self.value_of_signal,
            value_of_test=self.value_of_test,
            guards=guards,
            literals=literals,
            ages=ages,
            oscillations=oscillations,
            recurring=self._of(ir.Recurs),
            derived=derived,
            held=self._of(ir.Held),
            sinces=self._of(ir.Since),
            sampled=self._sampled(),
            windows=self._windows(),
            node_of_proposition={proposition: node for node, proposition in enumerate(order)},
            proposition_names={
                proposition: self._proposition_name(proposition) for proposition in order
            },
            rule_names=_named("rule_", [rule.name for rule in self.machine.rules]),
            channel_names=_named("", [channel.topic for channel in self.machine.channels]),
            input_names=_named("INPUT_", [used.name for used in self.machine.inputs]),
        )

    # --- values ------------------------------------------------------------------------------

    def _keep(self, text: str, place: str, support: ir.Support, **index: int) -> int:
        remark = f"{place}  {text}"
        self.values.append(Value(self.family.name(text), remark, support, **index))
        return len(self.values) - 1

    def _slots(self) -> None:
        """A signal that reads a slot shares the place of the slot."""
        kept: dict[int, int] = {}
        known_as, _ = ir.field_names(self.machine)
        for index, slot in enumerate(self.machine.slots):
            used = self.machine.inputs[slot.input]
            path = ".".join((used.name, *map(str, slot.path)))
            text = min(known_as[index], key=len, default=path)
            support = ir.Support(
                slots=frozenset({index}),
                inputs=frozenset({slot.input}),
                channels=frozenset({used.channel}),
            )
            kept[index] = self._keep(text, names.place(used.span), support, slot=index)
        for index, signal in enumerate(self.machine.signals):
            if isinstance(signal.node, ir.Read):
                self.value_of_signal[index] = kept[signal.node.slot]

    def _signals(self) -> None:
        for index, signal in enumerate(self.machine.signals):
            is_kept = not isinstance(signal.node, ir.Constant | ir.Read)
            if is_kept and self.elements.signals[index] is None:
                support = self.supports.signals[index]
                self.value_of_signal[index] = self._keep(
                    signal.text, names.place(signal.span), support, signal=index
                )

    def _sampled(self) -> tuple[int, ...]:
        """The signals whose last two samples are stored; for functions that feed back, their
        results.
        """
        rows = [(i, node, sampling_row(node.function)) for i, node in self._samplings()]
        last = {
            index if row.feeds_back else node.signal
            for index, node, row in rows
            if not row.has_window
        }
        return tuple(sorted(last))

    def _windows(self) -> tuple[SampleWindow, ...]:
        """The windows in which samples are remembered."""
        nodes = [n for _, n in self._samplings() if sampling_row(n.function).has_window]
        return tuple(sorted({SampleWindow(node.signal, node.window_ns) for node in nodes}))

    def _samplings(self) -> Iterator[tuple[int, ir.Sampled]]:
        """The functions of samples. A number that depends on no input is never sampled."""
        for index, signal in enumerate(self.machine.signals):
            node = signal.node
            if isinstance(node, ir.Sampled) and self.supports.signals[node.signal].channels:
                yield index, node

    # --- propositions
    # ------------------------------------------------------------------------------

    def _of(self, *kinds: type[ir.PropositionNode]) -> tuple[int, ...]:
        return tuple(i for i in self.whole if isinstance(self.machine.propositions[i].node, kinds))

    def _is_still(self, index: int) -> bool:
        """Say whether an oscillation depends on no input, so that it never swings (S32)."""
        return not self.supports.propositions[index].channels

    def _proposition_name(self, index: int) -> str:
        proposition = self.machine.propositions[index]
        return self.proposition_family.name(proposition.name or proposition.text)

    def _leaf(self, index: int) -> None:
        node = self.machine.propositions[index].node
        if not isinstance(node, ir.Compare | ir.Between | ir.Flag | ir.Quantified):
            return
        fixed = limits_of(self.machine, node)
        if fixed is None:
            value, found = self._test(index), [PropositionLimit(0.5, True)]
        else:
            value, found = self.value_of_signal[fixed.signal], fixed.limits
        guard = self._guard(value)
        guard.leaves.append(index)
        guard.limits += [PropositionLimit(limit.at, limit.rises, index) for limit in found]

    def _test(self, index: int) -> int:
        proposition = self.machine.propositions[index]
        support = self.supports.propositions[index]
        value = self._keep(proposition.text, names.place(proposition.span), support, test=index)
        self.value_of_test[index] = value
        return value

    def _guard(self, value: int) -> ValueGuard:
        if value not in self.guards:
            name = self.guard_family.name(self.values[value].name.removeprefix("VALUE_"))
            self.guards[value] = ValueGuard(name, value)
        return self.guards[value]


def _sort(guard: ValueGuard) -> None:
    """Sort limits from low to high, and leaves by their lowest limits."""
    guard.limits.sort(key=lambda limit: limit.at)
    lowest: dict[int, int] = {}
    for number, limit in enumerate(guard.limits):
        lowest.setdefault(limit.leaf, number)
    guard.leaves.sort(key=lambda leaf: lowest.get(leaf, -1))


def _named(prefix: str, texts: Sequence[str]) -> tuple[str, ...]:
    give: Callable[[str], str] = names.Family(prefix).name
    return tuple(give(text) for text in texts)
