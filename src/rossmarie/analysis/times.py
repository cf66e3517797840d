"""The times of a trace of events, taken from the durations in the rules."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property

from rossmarie import ir
from rossmarie.analysis.encoding import Questioned

SECOND = 1_000_000_000
_LONGEST_PERIOD_NS = SECOND // 10


class Times:
    """The times of a trace, taken from a part of a machine: its channels, and the operands of its
    propositions.
    """

    def __init__(self, asked: Questioned, propositions: Sequence[int]) -> None:
        machine = asked.machine
        support = [asked.supports.propositions[proposition] for proposition in propositions]
        self.channels = tuple(
            sorted(set().union(*(ir.all_channels(machine, each) for each in support)))
        )
        self.propositions = tuple(
            sorted(
                {
                    below
                    for root in propositions
                    for below in ir.reachable_propositions(machine, root)
                }
            )
        )
        inputs = [used for used in machine.inputs if used.channel in self.channels]
        self.timeouts = [used.timeout_ns for used in inputs if used.timeout_ns is not None]
        self.silence_ns = max([*self.timeouts, *self._ages(machine)], default=0)
        self._settled = self._settling(asked)
        self.longest_ns = max(self._settled.values(), default=0) + self.silence_ns + self.period_ns
        windows = [
            node.window_ns
            for proposition in self.propositions
            if isinstance(node := machine.propositions[proposition].node, ir.Oscillates)
        ]
        windows += [asked.window_of(sample) for each in support for sample in each.samples]
        second_sample = 2 * self.period_ns if any(each.samples for each in support) else 0
        self.shortest_ns = max([second_sample, *windows])

    def settling(self, proposition: int) -> int:
        """The time in nanoseconds that a proposition takes to settle after the last change."""
        return self._settled[proposition]

    @cached_property
    def period_ns(self) -> int:
        """The time between two messages of a channel, in nanoseconds."""
        least = min((timeout // 2 for timeout in self.timeouts), default=_LONGEST_PERIOD_NS)
        return max(min(least, _LONGEST_PERIOD_NS), 1)

    def _ages(self, machine: ir.Machine) -> Iterator[int]:
        for proposition in self.propositions:
            node = machine.propositions[proposition].node
            if isinstance(node, ir.AgeReaches):
                yield node.age_ns

    def _settling(self, asked: Questioned) -> dict[int, int]:
        """The time in nanoseconds that each proposition takes to settle after the last change."""
        machine = asked.machine
        needed: dict[int, int] = {}
        for proposition in self.propositions:
            node = machine.propositions[proposition].node
            below = 0
            if not isinstance(node, ir.Quantified):
                below = max((needed[each] for each in ir.proposition_operands(node)), default=0)
            if ir.is_leaf(node):
                samples = asked.supports.propositions[proposition].samples
                below += sum(map(asked.window_of, samples))
            match node:
                case ir.Held(duration_ns=duration_ns):
                    below += duration_ns
                case ir.Oscillates(window_ns=window_ns) | ir.Recurs(window_ns=window_ns):
                    below += window_ns
                case (
                    ir.Literal() | ir.Compare() | ir.Between() | ir.Flag() | ir.AgeReaches()
                    | ir.Quantified() | ir.Not() | ir.And() | ir.Or() | ir.Since()
                ):  # fmt: skip
                    pass
            needed[proposition] = below
        return needed
