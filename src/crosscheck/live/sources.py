"""Somebody who has to speak again and again."""

from __future__ import annotations

from dataclasses import dataclass

FIRST_PATIENCE = 5.0
"""Seconds in which somebody is heard for the first time: ROS takes its time to connect."""


@dataclass
class Source:
    """Somebody who is silent after `patience` seconds. `heard` is when he spoke last, before that
    when he was listened to first.
    """

    patience: float
    heard: float
    has_spoken: bool = False

    def speaks(self, at: float) -> None:
        """He is heard."""
        self.heard, self.has_spoken = at, True

    def silence(self, at: float) -> float | None:
        """The seconds for which he has been silent, if that is longer than he may be."""
        may = self.patience if self.has_spoken else max(self.patience, FIRST_PATIENCE)
        lasts = at - self.heard
        return lasts if lasts > may else None
