"""EZS9xx: defects of this tool itself."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class InternalError(Error, code="EZS900", name="internal-error"):
    """Something that cannot happen did."""

    title = "this is a defect of ezskiros, not of your skills"
    help = "please report it, with the file that you checked"


ALL: tuple[type[Template], ...] = (InternalError,)
