"""EZS83x: skills that BehaviorTree.CPP cannot express."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template, Warning


class ComputedArgument(Error, code="EZS830", name="computed-port"):
    """A value that Python computes when the skill starts."""

    title = "BehaviorTree.CPP cannot compute the value of `{parameter}`"
    note = "the blackboard of BehaviorTree.CPP only passes values unchanged"
    help = "pass a constant or an unchanged parameter: `{parameter}=params.{parameter}`"
    parameter: str


class NoPort(Error, code="EZS831", name="no-port"):
    """A parameter whose name is not a valid port name."""

    title = "`{spelled}` is not a valid port name in BehaviorTree.CPP"
    note = "a port name begins with a letter from a to z, and is neither `name` nor `ID`"
    help = "rename the parameter"
    spelled: str


class TakenName(Error, code="EZS832", name="taken-name"):
    """A skill with the name of a built-in node of BehaviorTree.CPP."""

    title = "BehaviorTree.CPP has a built-in node `{spelled}`"
    help = "rename the skill or its implementation"
    spelled: str


class NoLiteral(Error, code="EZS833", name="no-literal"):
    """A value that BehaviorTree.CPP reads differently, or not at all, from the text of a port."""

    title = "BehaviorTree.CPP does not read {text} as this value"
    note = "{why}"
    help = "pass a parameter of the skill instead"
    text: str
    why: str


class LimitTooLarge(Error, code="EZS834", name="limit-too-large"):
    """A number of tries or a time beyond the range of BehaviorTree.CPP."""

    title = "the limit of this {decorator} is too large for BehaviorTree.CPP"
    note = "BehaviorTree.CPP stores tries in 31 bits and milliseconds in 32 bits"
    help = "use a smaller limit"
    decorator: str


class CallsItself(Error, code="EZS835", name="calls-itself"):
    """A recursive compound skill."""

    title = "`{skill}` contains itself, and BehaviorTree.CPP cannot load recursive trees"
    help = "write the loop as `self.retry(...)`, or give a smaller `--depth`"
    skill: str


class SeveralTrees(Warning, code="EZS836", name="several-trees"):
    """A nested compound skill with more than one tree."""

    title = "`{skill}` has several trees and is exported as one action"
    note = "the tree is chosen when the skill starts; XML for BehaviorTree.CPP can only contain one"
    skill: str


class ComputedLimit(Error, code="EZS837", name="computed-limit"):
    """A limit that Python computes or converts when the skill starts."""

    title = "BehaviorTree.CPP cannot compute the limit of this {decorator}"
    note = "the blackboard only passes values unchanged, and `Timeout` counts milliseconds"
    help = "write a number; `self.retry(child, params.Count)` can be exported as well"
    decorator: str


ALL: tuple[type[Template], ...] = (
    ComputedArgument,
    NoPort,
    TakenName,
    NoLiteral,
    LimitTooLarge,
    CallsItself,
    SeveralTrees,
    ComputedLimit,
)
