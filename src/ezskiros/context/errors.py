"""EZS872 and EZS873: the guards file, which makes skills wait for rules."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class NoGuards(Error, code="EZS872", name="no-guards"):
    """A file that is not a guards file, or has another version."""

    title = "`{path}` is not a guards file"
    label = "{reason}"
    help = "create the file with `crosscheck weave`"
    path: str
    reason: str


class OtherGuards(Error, code="EZS873", name="other-guards"):
    """A guards file of other skills than the running ones."""

    title = "`{path}` has guards for other skills than those in `{export}`"
    label = "the digest in `{export}` is `{digest}`"
    help = "create the file again with `crosscheck weave`"
    path: str
    export: str
    digest: str


ALL: tuple[type[Template], ...] = (NoGuards, OtherGuards)
