"""EZS872 and EZS873: the file of guards that lets skills wait for rules."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class NoGuards(Error, code="EZS872", name="no-guards"):
    """A file that has no guards of skills, or one of another version."""

    title = "`{path}` is no file of guards"
    label = "{reason}"
    help = "write it with `crosscheck weave`"
    path: str
    reason: str


class OtherGuards(Error, code="EZS873", name="other-guards"):
    """Guards of other skills than those that are run."""

    title = "`{path}` has guards of other skills than those in `{export}`"
    label = "the digest there is `{digest}`"
    help = "write it again with `crosscheck weave`"
    path: str
    export: str
    digest: str


ALL: tuple[type[Template], ...] = (NoGuards, OtherGuards)
