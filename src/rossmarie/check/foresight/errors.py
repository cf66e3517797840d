"""Mistakes about motions, and about the requirements of rules."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class UnknownMotionPart(Error, code="ROSS263", name="unknown-motion-part"):
    """A part that no motion has."""

    title = "a motion has no part `{identifier}`"
    label = "its parts are {known}"
    identifier: str
    known: str


class IncompleteMotion(Error, code="ROSS264", name="incomplete-motion"):
    """A motion with a missing part."""

    title = "motion `{motion}` has no {missing}"
    label = "the stopping distance cannot be computed"
    help = "add {form}"
    motion: str
    missing: str
    form: str


class UnlimitedReaction(Error, code="ROSS266", name="unlimited-reaction"):
    """A motion that depends on an input whose loss is not noticed."""

    title = "motion `{motion}` is measured by `{input}`, which has no timeout"
    label = "missing messages would go unnoticed, so no stopping distance is long enough"
    help = "declare the longest wait for a message: `input {input} = ... timeout 0.2 sec;`"
    motion: str
    input: str


class UndeclaredMotion(Error, code="ROSS267", name="undeclared-motion"):
    """A rule that keeps a motion that does not exist."""

    title = "motion `{identifier}` is not declared"
    label = "no motion has this name"
    help = "declare it: `motion {identifier} {{ position : INPUT; speed : INPUT; ... }}`"
    identifier: str

    class Declared(Remark):
        says = "declared are {known}"
        known: str


class KeptGivesWay(Error, code="ROSS270", name="kept-gives-way"):
    """A rule with a requirement that another rule switches off."""

    title = "rule `{rule}` keeps `{motion}` below a speed, but gives way to `{other}`"
    label = "while `{other}` is active, no rule keeps `{motion}` below the speed"
    help = "remove `unless {other}`, or keep the speed in another rule that gives way to no rule"
    rule: str
    motion: str
    other: str


ALL: tuple[type[Template], ...] = (
    UnknownMotionPart,
    IncompleteMotion,
    UnlimitedReaction,
    UndeclaredMotion,
    KeptGivesWay,
)
