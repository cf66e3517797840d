"""Findings of this package."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class NothingToWatch(Error, code="ROSS625", name="nothing-to-watch"):
    """A recording without messages that first rules can be written about."""

    title = "cannot write first rules for this recording: {reason}"
    note = "first rules are written for {known}; the recording holds {recorded}"
    help = "write the system model with `rossmarie model`, and declare the inputs by hand"
    reason: str
    known: str
    recorded: str


ALL: tuple[type[Template], ...] = (NothingToWatch,)
