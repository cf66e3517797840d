"""The operator of the arm."""

from __future__ import annotations

from heron.experiments.summons import Summons
from heron.guard import Guard
from heron.robot.arm_controller import ArmController

_LEADING_NS = 2_000_000_000


class ArmOperator:
    """Leads the arm up by hand, tells it where the table is, and resets the rules."""

    period_ns = 100_000_000

    def __init__(self, guard: Guard, controller: ArmController, height: float) -> None:
        self.summons = Summons(guard)
        self._controller = controller
        self._height = height

    def tick(self, now_ns: int) -> None:
        """Look after the arm."""
        presence_ns = self.summons.presence_ns(now_ns)
        if presence_ns == 0:
            self._controller.lead_up(self._height)
        elif presence_ns is not None and presence_ns >= _LEADING_NS:
            self.summons.reset()
