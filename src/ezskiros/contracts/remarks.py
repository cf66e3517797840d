"""Remarks of findings about contracts: at other places, and about repairs."""

from __future__ import annotations

from dslkit.diagnostics import Remark

# --- places ---------------------------------------------------------------------------------------


class ConditionOf(Remark):
    """The label of a condition."""

    says = "{kind}-condition of `{skill}`"
    kind: str
    skill: str


class ByWhich(Remark):
    """The label of a condition from which another one follows."""

    says = "{kind}-condition of `{skill}`, which implies `{condition}`"
    kind: str
    skill: str
    condition: str


class ComesHere(Remark):
    """The label of the child whose condition excludes another one."""

    says = "`{skill}` runs here"
    skill: str


class CalledHere(Remark):
    """The label of the child that has ended a condition."""

    says = "`{skill}` is called here"
    skill: str


class HasEnded(Remark):
    """The label of a post-condition of a child."""

    says = "this has ended, or may have ended, the condition"


class BeforeItFailed(Remark):
    """The label of a post-condition of a child that has failed."""

    says = "the failed child may already have done this"


class Meanwhile(Remark):
    """The label of a post-condition of a child that runs at the same time."""

    says = "this may happen before, or at the same time"


class ItsTree(Remark):
    """The label of the tree of a compound skill."""

    says = "its tree"


# --- knowledge ------------------------------------------------------------------------------------


class Why(Remark):
    """The note with the reason why conditions exclude each other."""

    says = "{why}"
    why: str


class KnownThere(Remark):
    """The note that lists the known conditions."""

    says = "known at this point: {conditions}"
    conditions: str


class NothingKnown(Remark):
    """The note without known conditions."""

    says = "nothing is known about these individuals at this point"


class OnThePath(Remark):
    """The note with the path through the tree."""

    says = "this is on the path where {path}"
    path: str


class Branch(Remark):
    """The note that identifies one of several trees."""

    says = "`expandBT` branches: this is the tree with {children}"
    children: str


# --- repairs --------------------------------------------------------------------------------------


class AddPreCondition(Remark):
    """A pre-condition is missing."""

    says = "if `{condition}` holds before `{skill}`, add it to the description of `{skill}`"
    skill: str
    condition: str


class AddElseInsert(Remark):
    """A pre-condition is missing, or a child."""

    says = (
        "if `{condition}` holds before `{skill}`, add it to the description of `{skill}`; "
        "otherwise insert `{child}` before this child"
    )
    skill: str
    condition: str
    child: str


class PassWithPreCondition(Remark):
    """A condition is about an individual that is not a parameter of the compound skill."""

    says = "pass a parameter of `{skill}` for `{name}`, and add this as a pre-condition"
    skill: str
    name: str


class SayInPreConditions(Remark):
    """A missing pre-condition that cannot be written out."""

    says = "add this to the pre-conditions of `{skill}`"
    skill: str


class OneAfterTheOther(Remark):
    """Two children interfere with each other."""

    says = "run them one after the other: `self.serialstar(...)`"


class Insert(Remark):
    """A child is missing."""

    says = "insert `{child}` before this child"
    child: str


class MoveIfNeeded(Remark):
    """A child may come too late."""

    says = "move this before `{child}`, if the condition must hold then"
    child: str


class Move(Remark):
    """A child comes too late."""

    says = "move this before `{child}`"
    child: str


class PassParameter(Remark):
    """A child changes an individual that no other child has."""

    says = "pass `{child}` a parameter of `{skill}` for `{name}`"
    child: str
    skill: str
    name: str


class StillStands(Remark):
    """A parameter of the compound has another name in the child."""

    says = "write `{call}`: {names} still has the value from an earlier child"
    call: str
    names: str


class Restore(Remark):
    """A required child ends a condition."""

    says = "restore the condition before `{child}`"
    child: str


class Append(Remark):
    """A child at the end is missing."""

    says = "append `{child}`, or delete the condition"
    child: str


class LetAChild(Remark):
    """No child ensures a post-condition."""

    says = "add a child that ensures it, or delete the condition"


class OneOf(Remark):
    """There are several repairs."""

    says = "{repairs}"
    repairs: str
