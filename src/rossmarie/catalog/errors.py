"""ROSS9xx: defects of this tool itself."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class InternalError(Error, code="ROSS900", name="internal-error"):
    """An internal error: a case that cannot occur has occurred."""

    title = "internal error in rossmarie; the rules are not the cause"
    help = "please report the error, with the file that you checked"


ALL: tuple[type[Template], ...] = (InternalError,)
