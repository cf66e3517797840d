"""Placing: sends the arm to place its block, and waits for the end."""

from __future__ import annotations

from heron.tasks.outcome import Outcome
from heron.topics import ARM, Carrier


class Placing:
    """Begins after a second, when the force-torque sensor has been zeroed."""

    period_ns = 100_000_000
    _BEGIN_NS = 1_000_000_000

    def __init__(self, carrier: Carrier) -> None:
        self._carrier = carrier
        self._is_sent = False
        self.outcome = Outcome.RUNNING

    def tick(self, now_ns: int) -> None:
        """One period later."""
        if now_ns >= self._BEGIN_NS and not self._is_sent:
            self._is_sent = True
            self._carrier.server(ARM).send({"pose": "place"}, self._end)

    def _end(self, is_reached: bool) -> None:
        self.outcome = Outcome.COMPLETED if is_reached else Outcome.GIVEN_UP
