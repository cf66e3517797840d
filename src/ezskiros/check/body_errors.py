"""EZS539, EZS548, EZS549: code that always raises in methods that a check does not run."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template


class AlwaysFails(Error, code="EZS539", name="always-fails"):
    """Arithmetic that raises for every value of the parameters."""

    title = "this always fails: {reason}"
    note = "the skill fails here while the robot is running"
    reason: str


class UndefinedName(Error, code="EZS548", name="undefined-name"):
    """A name that neither the method nor its module defines."""

    title = "`{method}` uses `{spelled}`, which is not defined"
    note = "the skill fails here while the robot is running"
    method: str
    spelled: str


class NoAttribute(Error, code="EZS549", name="no-attribute"):
    """A missing attribute of `self` or of a module."""

    title = "`{method}` uses `{owner}.{spelled}`, but `{owner}` has no `{spelled}`"
    note = "the skill fails here while the robot is running"
    method: str
    owner: str
    spelled: str


ALL: tuple[type[Template], ...] = (AlwaysFails, UndefinedName, NoAttribute)
