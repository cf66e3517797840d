"""CHK9xx: internal errors of crosscheck."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class InternalError(Error, code="CHK900", name="internal-error"):
    """An unexpected exception in crosscheck."""

    title = "this is a defect of crosscheck, not of your robot"
    help = "please report it, with the files that you checked"


ALL: tuple[type[Template], ...] = (InternalError,)
