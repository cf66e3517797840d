"""Parameters of the running node in a machine: what it was given at its start comes in on a channel
of its own, and counts if it tightens.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rossmarie.core import Function
from rossmarie.ir.channels import Channel
from rossmarie.ir.model import Apply, Constant, Machine, Read, SignalNode

PREFIX = "~"
"""The beginning of the names of such channels; no topic of the rules begins like this."""

MESSAGE = "std_msgs/Float64"

FARTHEST = 1000.0
"""A value may be this many times the default, or one part in as many."""

AT_ZERO = 1e9
"""A value may be this far from a default of 0."""


@dataclass(frozen=True)
class NodeParameter:
    """A parameter of the node, in SI: between `usual` and `farthest`, which is greater if `is_up`,
    and shown in `unit`.
    """

    name: str
    channel: int
    usual: float
    farthest: float
    unit: str

    @property
    def is_up(self) -> bool:
        """Say whether a greater number is the tighter one."""
        return self.farthest > self.usual


def farthest(usual: float, *, is_up: bool) -> float:
    """The last value that counts. A number keeps its sign, so that products keep theirs."""
    if usual == 0.0:
        return AT_ZERO if is_up else -AT_ZERO
    return usual * FARTHEST if is_up is (usual > 0.0) else usual / FARTHEST


def is_setting(channel: Channel) -> bool:
    """Say whether a channel is no topic, but a parameter of the node."""
    return channel.topic.startswith(PREFIX)


def settings_of(machine: Machine) -> tuple[NodeParameter, ...]:
    """All parameters of the node, in the order of their channels."""
    found = {each.channel: each for each in _settings(machine)}
    return tuple(found[channel] for channel in sorted(found))


def _settings(machine: Machine) -> Iterator[NodeParameter]:
    for signal in machine.signals:
        numbers = setting_numbers(machine, signal.node)
        if numbers is not None:
            slot, usual, far = numbers
            used = machine.inputs[machine.slots[slot].input]
            name = machine.channels[used.channel].topic.removeprefix(PREFIX)
            yield NodeParameter(name, used.channel, usual, far, machine.slots[slot].unit)


def setting_numbers(machine: Machine, node: SignalNode) -> tuple[int, float, float] | None:
    """The slot, the default and the last value that counts, if a signal is a parameter."""
    if not isinstance(node, Apply) or node.function not in (Function.RAISED, Function.LOWERED):
        return None
    read, usual, far = (machine.signals[each].node for each in node.operands)
    if not (isinstance(read, Read) and isinstance(usual, Constant) and isinstance(far, Constant)):
        return None
    channel = machine.channels[machine.inputs[machine.slots[read.slot].input].channel]
    return (read.slot, usual.value, far.value) if is_setting(channel) else None
