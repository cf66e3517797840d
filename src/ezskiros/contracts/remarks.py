"""Remarks of findings about contracts: at other places, and about repairs."""

from __future__ import annotations

from dslkit.diagnostics import Remark

# --- places


class ConditionOf(Remark):
    """The label of a condition."""

    says = "{kind}-condition of `{skill}`"
    kind: str
    skill: str


class ByWhich(Remark):
    """The label of a condition from which another one follows."""

    says = "{kind}-condition of `{skill}`, by which `{condition}`"
    kind: str
    skill: str
    condition: str


class ComesHere(Remark):
    """The label of the child whose condition excludes another one."""

    says = "`{skill}` comes here"
    skill: str


class CalledHere(Remark):
    """The label of the child that has ended a condition."""

    says = "`{skill}` is called here"
    skill: str


class HasEnded(Remark):
    """The label of a post-condition of a child."""

    says = "this has ended it, or may have"


class BeforeItFailed(Remark):
    """The label of a post-condition of a child that has failed."""

    says = "it may have done this before it failed"


class Meanwhile(Remark):
    """The label of a post-condition of a child that runs beside."""

    says = "it may do this before, or meanwhile"


class ItsTree(Remark):
    """The label of the tree of a compound skill."""

    says = "its tree"


# --- what is known there


class Why(Remark):
    """The note that says why conditions exclude each other."""

    says = "{why}"
    why: str


class KnownThere(Remark):
    """The note that lists what is known."""

    says = "known there: {conditions}"
    conditions: str


class NothingKnown(Remark):
    """The note where nothing is known."""

    says = "nothing is known there of these things"


class OnTheWay(Remark):
    """The note that says on which way through the tree that is."""

    says = "this is so where {way}"
    way: str


class Branch(Remark):
    """The note that says which of several trees it is."""

    says = "`expandBT` branches: this is the tree with {children}"
    children: str


# --- repairs


class AddPreCondition(Remark):
    """A pre-condition is missing."""

    says = "if it holds before `{skill}`, add `{condition}` to its description"
    skill: str
    condition: str


class AddElseInsert(Remark):
    """A pre-condition is missing, or a child."""

    says = (
        "if it holds before `{skill}`, add `{condition}` to its description; else insert "
        "`{child}` before"
    )
    skill: str
    condition: str
    child: str


class PassWithPreCondition(Remark):
    """A condition is about something that the compound does not know."""

    says = "pass a parameter of `{skill}` for `{name}`, with this as a pre-condition"
    skill: str
    name: str


class SayInPreConditions(Remark):
    """A pre-condition is missing that has no words of its own."""

    says = "say so in the pre-conditions of `{skill}`"
    skill: str


class OneAfterTheOther(Remark):
    """Two children are in the way of each other."""

    says = "run them one after the other: `self.serialstar(...)`"


class Insert(Remark):
    """A child is missing."""

    says = "insert `{child}` before"
    child: str


class MoveIfNeeded(Remark):
    """A child may come too late."""

    says = "move it before `{child}`, if it has to hold then"
    child: str


class Move(Remark):
    """A child comes too late."""

    says = "move it before `{child}`"
    child: str


class PassParameter(Remark):
    """A child changes something that nobody else knows."""

    says = "pass `{child}` a parameter of `{skill}` for `{name}`"
    child: str
    skill: str
    name: str


class StillStands(Remark):
    """A parameter of the compound has another name in the child."""

    says = "write `{call}`: {names} still stands for what an earlier child has found"
    call: str
    names: str


class Restore(Remark):
    """A condition is ended by something that has to be."""

    says = "restore it before `{child}`"
    child: str


class Append(Remark):
    """A child at the end is missing."""

    says = "append `{child}`, or leave the condition out"
    child: str


class LetAChild(Remark):
    """No child sees to a post-condition."""

    says = "let a child see to it, or leave the condition out"


class OneOf(Remark):
    """There are several repairs."""

    says = "{ways}"
    ways: str
