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

    title = "motion `{motion}` lacks {missing}"
    label = "the way on which it stops cannot be worked out"
    help = "add {form}"
    motion: str
    missing: str
    form: str


class UnlimitedReaction(Error, code="ROSS266", name="unlimited-reaction"):
    """A motion that depends on an input whose loss is not noticed."""

    title = "motion `{motion}` is seen by `{input}`, which has no timeout"
    label = "nobody notices when its messages end, so no way to stop is long enough"
    help = "say how long a message may be awaited: `input {input} = ... timeout 0.2 sec;`"
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

    title = "rule `{rule}` keeps `{motion}` below a speed, and gives way to `{other}`"
    label = "while `{other}` is active, nothing keeps it"
    help = "leave `unless {other}` out, or let another rule keep it, which gives way to nobody"
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
