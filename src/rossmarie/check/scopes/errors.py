"""Mistakes in declarations."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template, Warning


class DuplicateName(Error, code="ROSS105", name="duplicate-name"):
    """Two declarations of one name."""

    title = "`{identifier}` is declared twice"
    label = "this {kind} takes a name that already stands for {other}"
    note = "{reason}"
    help = "give one of the two another name"
    identifier: str
    kind: str
    other: str
    reason: str

    class First(Remark):
        says = "first declared here"


class CircularConstant(Error, code="ROSS113", name="circular-constant"):
    """A constant whose definition uses itself."""

    title = "constant `{identifier}` is defined by itself"
    label = "{cycle}"
    note = "the value of a constant has to be known before it can be used"
    help = "write the value of one of them as a number"
    identifier: str
    cycle: str

    class Part(Remark):
        says = "part of the circle"


class CircularCondition(Error, code="ROSS114", name="circular-condition"):
    """A condition that depends on itself."""

    title = "condition `{identifier}` depends on itself"
    label = "{cycle}"
    note = "the value of a condition follows from inputs; a circle of conditions has no start"
    help = "write one of them without the others"
    identifier: str
    cycle: str

    class Next(Remark):
        says = "and this on the next"


class SeveralContracts(Error, code="ROSS115", name="several-contracts"):
    """A rule with more than one resume contract."""

    title = "a rule has at most one resume contract"
    label = "this one contradicts the first"
    note = "it would not be clear which of them releases the actions"
    help = "keep one; two conditions for release can be joined: `clear when (A and B) for 2 sec`"

    class First(Remark):
        says = "the first contract"


class RepeatedAction(Warning, code="ROSS405", name="repeated-action"):
    """An action that one rule names twice."""

    title = "action `{identifier}` is named twice in one rule"
    label = "it is in force already"
    note = "an action is in force from its turn to the release; named again, it only begins again"
    help = "remove it"
    identifier: str

    class First(Remark):
        says = "first named here"


ALL: tuple[type[Template], ...] = (
    DuplicateName,
    CircularConstant,
    CircularCondition,
    SeveralContracts,
    RepeatedAction,
)
