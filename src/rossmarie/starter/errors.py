"""Findings of this package."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class NothingToWatch(Error, code="ROSS625", name="nothing-to-watch"):
    """A recording without messages that first rules can be written about."""

    title = "no rules can be begun from this recording: {reason}"
    note = "rules are begun from {known}; the recording holds {recorded}"
    help = "write the system model by `rossmarie model`, and name the inputs by hand"
    reason: str
    known: str
    recorded: str


ALL: tuple[type[Template], ...] = (NothingToWatch,)
