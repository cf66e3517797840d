"""A source of messages that has to be heard again and again."""

from __future__ import annotations

from dataclasses import dataclass

FIRST_PATIENCE = 5.0
"""Seconds in which the first message has to come: ROS takes its time to connect."""


@dataclass
class Source:
    """A source that counts as silent after `patience` seconds. `heard` is the time of its last
    message; before the first one, the time at which listening began.
    """

    patience: float
    heard: float
    has_spoken: bool = False

    def speaks(self, at: float) -> None:
        """A message comes."""
        self.heard, self.has_spoken = at, True

    def silence(self, at: float) -> float | None:
        """The seconds since the last message, if they are more than the source may take."""
        may = self.patience if self.has_spoken else max(self.patience, FIRST_PATIENCE)
        lasts = at - self.heard
        return lasts if lasts > may else None
