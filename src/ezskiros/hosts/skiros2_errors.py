"""EZS88x: reasons why SkiROS2 cannot load a skill."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class CallsRefused(Error, code="EZS880", name="calls-refused"):
    """A child of a compound skill that SkiROS2 does not have."""

    title = "SkiROS2 does not have `{spelled}`, which this skill calls"
    label = "refused, or from a library without `host(__name__)`"
    note = "SkiROS2 would only notice this at run time, after the earlier children have run"
    help = "correct the errors of `{spelled}`, or add `host(__name__)` to its library"
    spelled: str


class DescriptionRefused(Error, code="EZS882", name="description-refused"):
    """An implementation of a skill that SkiROS2 does not have."""

    title = "SkiROS2 does not have `{spelled}`, which this class implements"
    label = "the skill was refused, or its library has no `host(__name__)`"
    help = "correct the errors of `{spelled}`, or add `host(__name__)` to its library"
    spelled: str


ALL: tuple[type[Template], ...] = (CallsRefused, DescriptionRefused)
