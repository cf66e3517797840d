"""CHK9xx: defects of this tool itself."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class InternalError(Error, code="CHK900", name="internal-error"):
    """An internal error: a case that cannot occur has occurred."""

    title = "this is a defect of crosscheck, not of your robot"
    help = "please report it, with the files that you checked"


ALL: tuple[type[Template], ...] = (InternalError,)
