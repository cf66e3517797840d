"""EZS88x: what keeps a skill from being loaded by SkiROS2."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class CallsRefused(Error, code="EZS880", name="calls-refused"):
    """A child of a compound skill that SkiROS2 does not have."""

    title = "SkiROS2 does not have `{spelled}`, which this skill calls"
    label = "refused, or of a library without `host(__name__)`"
    note = "SkiROS2 would notice when the skill runs, with the children before it already done"
    help = "correct what `{spelled}` is refused for, or host its library"
    spelled: str


class DescriptionRefused(Error, code="EZS882", name="description-refused"):
    """An implementation of a skill that SkiROS2 does not have."""

    title = "SkiROS2 does not have `{spelled}`, which this implements"
    label = "of a skill that was refused, or of a library without `host(__name__)`"
    help = "correct what `{spelled}` is refused for, or host its library"
    spelled: str


ALL: tuple[type[Template], ...] = (CallsRefused, DescriptionRefused)
