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

    title = "constant `{identifier}` depends on itself"
    label = "{cycle}"
    note = "the value of a constant must be known before it is used"
    help = "write the value of one of these constants as a number"
    identifier: str
    cycle: str

    class Part(Remark):
        says = "part of the cycle"


class CircularCondition(Error, code="ROSS114", name="circular-condition"):
    """A condition that depends on itself."""

    title = "condition `{identifier}` depends on itself"
    label = "{cycle}"
    note = "conditions are computed from inputs; a cycle of conditions has no start"
    help = "write one of these conditions without the others"
    identifier: str
    cycle: str

    class Next(Remark):
        says = "this condition depends on the next"


class SeveralContracts(Error, code="ROSS115", name="several-contracts"):
    """A rule with more than one resume contract."""

    title = "a rule has at most one resume contract"
    label = "this contract contradicts the first"
    note = "it would not be clear which contract clears the rule"
    help = "keep one contract; to join two conditions, write `clear when (A and B) for 2 sec`"

    class First(Remark):
        says = "the first contract"


class RepeatedAction(Warning, code="ROSS405", name="repeated-action"):
    """An action that one rule names twice."""

    title = "action `{identifier}` is named twice in one rule"
    label = "this action is already in force"
    note = (
        "an action is in force from its turn until the rule is cleared; naming the action again "
        "only restarts it"
    )
    help = "remove the second name"
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
