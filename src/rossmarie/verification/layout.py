"""The parts of a monitor, sorted by their meaning, each with its place in the generated C.

The input is a machine, which determines the parts and their operands. The generator (`places.py`)
determines the places. Each part needs a place of its own, so that the queries cover every part. If
a part has none, there are no queries, and nothing is proved.
"""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterable, Mapping
from dataclasses import dataclass

from rossmarie.core import sampling_row
from rossmarie.ir import model as ir
from rossmarie.verification import supports
from rossmarie.verification.places import MachinePlaces, WatchedGuard, places_of
from rossmarie.verification.supports import Support, SupportArrays

_WORD = 64
"""The number of marks that fit one word."""


class MisplacedError(Exception):
    """The generator has no place for a part, or one place for two parts. This is a defect of this
    program.
    """


@dataclass(frozen=True)
class KeptNumber:
    """A number that a monitor keeps: the value of a slot, of a signal, or of a comparison
    (`test`).
    """

    remark: str
    support: Support
    slot: int | None = None
    signal: int | None = None
    test: int | None = None


@dataclass(frozen=True)
class ProofLayout:
    """The layout of one machine. Lists of propositions have the monitor's own order.

    `held`, `sinces`, `oscillations`, `recurring`, `sampled` and `windows` have the order of the
    memory that belongs to them. `windows` are signals, each with the time in ns for which its
    samples are kept.
    """

    machine: ir.Machine
    places: MachinePlaces
    elements: SupportArrays
    values: tuple[KeptNumber, ...]
    value_of_signal: Mapping[int, int]
    guards: tuple[WatchedGuard, ...]
    literals: tuple[int, ...]
    ages: tuple[int, ...]
    oscillations: tuple[int, ...]
    recurring: tuple[int, ...]
    derived: tuple[int, ...]
    held: tuple[int, ...]
    sinces: tuple[int, ...]
    sampled: tuple[int, ...]
    windows: tuple[tuple[int, int], ...]
    node_of_proposition: Mapping[int, int]

    @property
    def name(self) -> str:
        """The prefix of the names of all public functions."""
        return self.places.name

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
        return self.proposition_count - len(self.oscillations) - len(self.derived)

    @property
    def proposition_count(self) -> int:
        """The number of propositions that a monitor keeps."""
        return len(self.node_of_proposition)

    @property
    def is_small(self) -> bool:
        """True if the marks of all propositions and rules fit one word."""
        return self.proposition_count + len(self.machine.rules) <= _WORD

    # --- meanings ----------------------------------------------------------------------------

    def support_of_signal(self, signal: int) -> Support:
        """The support of a signal."""
        return supports.support(self.machine, (signal,), ())

    def support_of_proposition(self, proposition: int) -> Support:
        """The support of a proposition."""
        return supports.support(self.machine, (), (proposition,))

    def has_timeout(self, used: int) -> bool:
        """Say whether an input expires."""
        return self.machine.inputs[used].timeout_ns is not None

    def aged_inputs(self) -> set[int]:
        """The inputs whose age a proposition uses."""
        nodes = (self.machine.propositions[index].node for index in self.ages)
        return {node.input for node in nodes if isinstance(node, ir.AgeReaches)}

    def guards_of(self, channel: int) -> list[WatchedGuard]:
        """The guards that a message on a channel can make a number leave."""
        return [g for g in self.guards if channel in self.values[g.value].support.channels]


def layout_of(machine: ir.Machine) -> ProofLayout:
    """The parts of a machine. Raises `MisplacedError`."""
    return _Sorted(machine).layout()


class _Sorted:
    """The parts of a machine, sorted by their kind."""

    def __init__(self, machine: ir.Machine) -> None:
        self._machine = machine
        self._places = places_of(machine)
        self._elements = supports.elements(machine)
        arrays = self._elements
        self._propositions = [
            index for index, array in enumerate(arrays.propositions) if array is None
        ]
        self._signals = [index for index, array in enumerate(arrays.signals) if array is None]

    def layout(self) -> ProofLayout:
        swings = self._of(ir.Oscillates)
        still = [index for index in swings if not self._channels(index)]
        derived = self._of(ir.Not, ir.And, ir.Or, ir.Held, ir.Since, ir.Recurs)
        self._check([index for index in swings if index not in still])
        return ProofLayout(
            machine=self._machine,
            places=self._places,
            elements=self._elements,
            values=self._values(),
            value_of_signal=self._value_of_signal(),
            guards=self._places.guards,
            literals=(*self._of(ir.Literal), *still),
            ages=tuple(self._of(ir.AgeReaches)),
            oscillations=self._places.oscillations,
            recurring=self._places.recurring,
            derived=tuple(sorted(derived, key=self._places.node_of_proposition.__getitem__)),
            held=self._places.held,
            sinces=self._places.sinces,
            sampled=self._places.sampled,
            windows=self._places.windows,
            node_of_proposition=self._places.node_of_proposition,
        )

    def _of(self, *kinds: type[ir.PropositionNode]) -> list[int]:
        return [
            i for i in self._propositions if isinstance(self._machine.propositions[i].node, kinds)
        ]

    def _channels(self, proposition: int) -> frozenset[int]:
        """The channels on which a proposition depends. An oscillation that depends on no input
        never swings (S32).
        """
        return supports.support(self._machine, (), (proposition,)).channels

    # --- numbers -----------------------------------------------------------------------------

    def _value_of_signal(self) -> dict[int, int]:
        """The place of each signal. A signal that reads a slot has the place of the slot."""
        found = {}
        for index in self._signals:
            match self._machine.signals[index].node:
                case ir.Constant():
                    pass
                case ir.Read(slot=slot):
                    found[index] = self._places.value_of_slot[slot]
                case ir.Apply() | ir.Sampled() | ir.Fold() | ir.Count() | ir.Element():
                    found[index] = _place(self._places.value_of_signal, index, "a number")
        return found

    def _values(self) -> tuple[KeptNumber, ...]:
        remarks, machine = self._places.remarks, self._machine
        found: dict[int, list[KeptNumber]] = {}

        def keep(place: int, support: Support, **index: int) -> None:
            _must(0 <= place < len(remarks), "a number is kept outside of its array")
            found.setdefault(place, []).append(KeptNumber(remarks[place], support, **index))

        _must(len(self._places.value_of_slot) == len(machine.slots), "a slot has no place")
        for slot, place in enumerate(self._places.value_of_slot):
            keep(place, supports.of_slot(machine, slot), slot=slot)
        for signal, place in self._value_of_signal().items():
            if not isinstance(machine.signals[signal].node, ir.Read):
                keep(place, supports.support(machine, (signal,), ()), signal=signal)
        for proposition, place in self._places.value_of_test.items():
            keep(place, supports.support(machine, (), (proposition,)), test=proposition)
        _must(sorted(found) == list(range(len(remarks))), "a place stands for no number")
        _must(all(len(each) == 1 for each in found.values()), "two numbers have the same place")
        return tuple(found[place][0] for place in range(len(remarks)))

    # --- parts that need a place -------------------------------------------------------------

    def _check(self, moving: list[int]) -> None:
        """Raise `MisplacedError` if a part is missing, or if two parts share a place."""
        places, machine = self._places, self._machine
        nodes = places.node_of_proposition
        _same(nodes, self._propositions, "propositions")
        _same(nodes.values(), range(len(self._propositions)), "places of propositions")
        leaves = [leaf for guard in places.guards for leaf in guard.leaves]
        _same(leaves, self._of(ir.Compare, ir.Between, ir.Flag, ir.Quantified), "leaves of guards")
        _same(places.held, self._of(ir.Held), "durations")
        _same(places.sinces, self._of(ir.Since), "propositions that remember their value")
        _same(places.oscillations, moving, "oscillations")
        _same(places.recurring, self._of(ir.Recurs), "counts of edges")
        last, windows = self._remembered()
        _same(places.sampled, last, "signals of which samples are remembered")
        _same(places.windows, windows, "windows")
        names = range(len(machine.channels))
        _must(len(set(places.channel_names)) == len(names), "two channels have the same name")

    def _remembered(self) -> tuple[set[int], set[tuple[int, int]]]:
        """The signals whose last two samples are remembered, including functions that feed back
        their own results (S50); and the windows.
        """
        last: set[int] = set()
        windows: set[tuple[int, int]] = set()
        for index, signal in enumerate(self._machine.signals):
            match signal.node:
                case ir.Sampled(signal=sampled) as node:
                    row = sampling_row(node.function)
                    if not supports.support(self._machine, (sampled,), ()).channels:
                        continue
                    if row.has_window:
                        windows.add((sampled, node.window_ns))
                    else:
                        last.add(index if row.feeds_back else sampled)
                case (
                    ir.Constant() | ir.Read() | ir.Apply() | ir.Element() | ir.Fold()
                    | ir.Count()
                ):  # fmt: skip
                    pass
        return last, windows


def _place(places: Mapping[int, int], index: int, what: str) -> int:
    _must(index in places, f"{what} has no place")
    return places[index]


def _same(found: Iterable[Hashable], wanted: Collection[Hashable], what: str) -> None:
    """Raise `MisplacedError` unless both collections contain the same things, each once."""
    listed = list(found)
    _must(len(listed) == len(wanted) and set(listed) == set(wanted), f"{what} are misplaced")


def _must(is_so: bool, otherwise: str) -> None:
    if not is_so:
        raise MisplacedError(otherwise)
