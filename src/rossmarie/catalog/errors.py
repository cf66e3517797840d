"""ROSS9xx: defects of this tool itself."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class InternalError(Error, code="ROSS900", name="internal-error"):
    """An internal error: a case that cannot occur has occurred."""

    title = "this is a defect of rossmarie, not of your rules"
    help = "please report it, with the file that you checked"


ALL: tuple[type[Template], ...] = (InternalError,)
