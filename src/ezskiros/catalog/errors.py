"""EZS9xx: internal errors of ezskiros."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class InternalError(Error, code="EZS900", name="internal-error"):
    """An unexpected exception in ezskiros."""

    title = "this is a defect of ezskiros, not of your skills"
    help = "please report it, with the file that you checked"


ALL: tuple[type[Template], ...] = (InternalError,)
