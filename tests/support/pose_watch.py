"""A condition on a pose, and its proposition where the pose is."""

from __future__ import annotations

from collections.abc import Mapping

from rossmarie.interpreter import Interpreter
from rossmarie.ir import ChannelValues, Machine, TruthValue


class PoseWatch:
    """The only rule of a machine, which reads one pose. `frames` are the numbers of the texts that
    headers say; the first is the frame of a pose where none is named.
    """

    def __init__(self, machine: Machine, frames: Mapping[str, float]) -> None:
        self.machine = machine
        self._frames = frames
        self._monitor = Interpreter(machine)
        self._at_ns = 0

    def at(self, x: float, y: float, frame: str | None = None) -> TruthValue:
        """The proposition of the condition of the rule at a position in m."""
        self._at_ns += 1
        named = next(iter(self._frames)) if frame is None else frame
        known = {"x": x, "y": y, "frame_id": self._frames[named]}
        slots = {n: known[str(slot.path[-1])] for n, slot in enumerate(self.machine.slots)}
        self._monitor.update(self._at_ns, {0: ChannelValues(slots)})
        found = self._monitor._memory.truth_values[self.machine.rules[0].condition]
        assert found is not None
        return found
