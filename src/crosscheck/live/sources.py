"""A source of messages that has to report regularly."""

from __future__ import annotations

from dataclasses import dataclass

FIRST_PATIENCE = 5.0
"""The seconds within which the first message has to arrive. ROS needs this time to connect."""


@dataclass
class LiveSource:
    """A source that counts as silent after `patience` seconds. `heard` is the time of the last
    message; before the first message, the time of the subscription.
    """

    patience: float
    heard: float
    has_spoken: bool = False

    def speaks(self, at: float) -> None:
        """Record a message."""
        self.heard, self.has_spoken = at, True

    def silence(self, at: float) -> float | None:
        """The seconds since the last message if they exceed the patience of the source; otherwise
        None.
        """
        may = self.patience if self.has_spoken else max(self.patience, FIRST_PATIENCE)
        lasts = at - self.heard
        return lasts if lasts > may else None
