"""EZS24x: users' code that keeps a check from coming to its end."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class BrokenOff(Error, code="EZS240", name="check-broken-off"):
    """A check without a whole report."""

    title = "the check was broken off here: {reason}"
    note = "findings up to this point are shown; the rest is not checked"
    help = "look for code here, or in an imported module, that ends or blocks the process"
    reason: str


class CheckerChanged(Error, code="EZS241", name="checker-changed"):
    """Users' code that changes the modules of the checker."""

    title = "the checked code changed the checker: `{part}` is not what it was"
    note = "findings may be missing, so the result of this check does not count"
    help = "leave the modules of `ezskiros` and of Python as they are"
    part: str


ALL: tuple[type[Template], ...] = (BrokenOff, CheckerChanged)
