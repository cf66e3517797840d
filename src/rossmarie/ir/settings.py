"""Parameters of the running node in a machine. The start value of a parameter arrives on its own
channel, and counts only if it is tighter than the default.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rossmarie.core import Function
from rossmarie.ir.channels import Channel
from rossmarie.ir.model import Apply, Constant, Machine, Read, SignalNode

PREFIX = "~"
"""The prefix of the names of such channels. No topic of rules begins with it."""

MESSAGE = "std_msgs/Float64"

FARTHEST = 1000.0
"""The greatest ratio of a value to the default, and of the default to a value."""

AT_ZERO = 1e9
"""The greatest distance of a value from a default of 0."""


@dataclass(frozen=True)
class NodeParameter:
    """A parameter of the node, in SI. Its value lies between `usual`, the default, and `farthest`,
    which is greater if `is_up`. Its display unit is `unit`.
    """

    name: str
    channel: int
    usual: float
    farthest: float
    unit: str

    @property
    def is_up(self) -> bool:
        """Say whether a greater number is tighter."""
        return self.farthest > self.usual


def farthest(usual: float, *, is_up: bool) -> float:
    """The last value that counts. It has the sign of the default, so that signs of products stay
    the same.
    """
    if usual == 0.0:
        return AT_ZERO if is_up else -AT_ZERO
    return usual * FARTHEST if is_up is (usual > 0.0) else usual / FARTHEST


def is_setting(channel: Channel) -> bool:
    """Say whether a channel is a parameter of the node instead of a topic."""
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
    """The slot, the default and the last value that counts, if a signal is a parameter; else
    None.
    """
    if not isinstance(node, Apply) or node.function not in (Function.RAISED, Function.LOWERED):
        return None
    read, usual, far = (machine.signals[each].node for each in node.operands)
    if not (isinstance(read, Read) and isinstance(usual, Constant) and isinstance(far, Constant)):
        return None
    channel = machine.channels[machine.inputs[machine.slots[read.slot].input].channel]
    return (read.slot, usual.value, far.value) if is_setting(channel) else None
