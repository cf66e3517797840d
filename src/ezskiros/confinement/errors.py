"""EZS24x: user code that prevents a check from completing."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class BrokenOff(Error, code="EZS240", name="check-broken-off"):
    """A check that ended early."""

    title = "the check stopped early: {reason}"
    note = "the findings up to this point are shown; the rest was not checked"
    help = "look for code here, or in an imported module, that ends or blocks the process"
    reason: str


class CheckerChanged(Error, code="EZS241", name="checker-changed"):
    """User code that modifies the checker."""

    title = "the checked code modified `{part}` of the checker"
    note = "findings may be missing, so the result of this check is invalid"
    help = "do not modify the modules of `ezskiros` or Python"
    part: str


ALL: tuple[type[Template], ...] = (BrokenOff, CheckerChanged)
