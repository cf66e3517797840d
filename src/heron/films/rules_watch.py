"""The active rules, and the times of their activations."""

from __future__ import annotations

from collections.abc import Sequence

from heron.experiments import SimulatedNode
from heron.guard import Guard
from heron.robot.physics import Physics
from heron.topics import InProcess

Spans = dict[str, list[tuple[float, float]]]
"""The start and end times (s) of activations, by the names of the rules."""


class RulesWatch:
    """An observer that asks the guard 50 times a second."""

    period_ns = 20_000_000

    def __init__(self) -> None:
        self._guard: Guard | None = None
        self._physics: Physics | None = None
        self._since: dict[str, int] = {}
        self._now_ns = 0
        self._spans: Spans = {}

    def attend(
        self,
        physics: Physics,
        carrier: InProcess,  # noqa: ARG002
        guard: Guard | None,
    ) -> Sequence[SimulatedNode]:
        """Look on, if there is something to be seen."""
        self._physics, self._guard = physics, guard
        return [] if guard is None else [self]

    def tick(self, now_ns: int) -> None:  # noqa: ARG002
        """Ask."""
        assert self._guard is not None
        assert self._physics is not None
        self._now_ns = self._physics.elapsed_ns
        active = set(self._guard.active)
        for rule in [rule for rule in self._since if rule not in active]:
            self._end(rule)
        for rule in self._guard.active:
            self._since.setdefault(rule, self._now_ns)

    def spans(self) -> Spans:
        """Now that the episode is over."""
        for rule in list(self._since):
            self._end(rule)
        return self._spans

    def _end(self, rule: str) -> None:
        span = (self._since.pop(rule) * 1e-9, self._now_ns * 1e-9)
        self._spans.setdefault(rule, []).append(span)
