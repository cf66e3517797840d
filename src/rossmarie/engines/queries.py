"""Queries about the running skills, by the names that users give them, as in rules."""

from __future__ import annotations

from rossmarie.ir import Doing, Machine, Quantity
from rossmarie.ir.skills import SkillMessage, answer


class MachineQueries:
    """The queries of one machine. `named` maps the words of each query, `doing Push(Object:
    Fragile)`, to its slots: several inputs may have the same query.
    """

    def __init__(self, machine: Machine) -> None:
        self._steps = {
            index: step
            for index, slot in enumerate(machine.slots)
            for step in slot.path
            if isinstance(step, Doing | Quantity)
        }
        self.named: dict[str, list[int]] = {}
        self._of_channel: dict[int, list[int]] = {}
        self._channels: dict[str, int] = {}
        for index, step in self._steps.items():
            used = machine.inputs[machine.slots[index].input]
            self._of_channel.setdefault(used.channel, []).append(index)
            if isinstance(step, Doing):
                self.named.setdefault(str(step), []).append(index)
                self._channels[used.name] = used.channel

    def is_context(self, name: str, value: object) -> bool:
        """Say whether a value is a message about the running skills, for an input with queries."""
        return name in self._channels and hasattr(value, "running")

    def answers(self, name: str, message: SkillMessage) -> dict[int, float]:
        """The answers of a message to all queries on the topic of an input, by slot."""
        asked = self._of_channel[self._channels[name]]
        return {index: answer(self._steps[index], message) for index in asked}

    def words(self, index: int) -> str | None:
        """The words of the query in a slot; None if the slot has no words of its own."""
        step = self._steps.get(index)
        return str(step) if isinstance(step, Doing) else None
