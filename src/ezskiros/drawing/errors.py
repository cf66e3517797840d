"""EZS83x: what BehaviorTree.CPP cannot say."""

from __future__ import annotations

from dslkit.diagnostics import Error, Template, Warning


class ComputedArgument(Error, code="EZS830", name="computed-port"):
    """A value that Python computes when the skill is started."""

    title = "BehaviorTree.CPP cannot compute what `{parameter}` gets"
    note = "its blackboard passes values on as they are"
    help = "pass a parameter of the skill as it is, or a value: `{parameter}=params.{parameter}`"
    parameter: str


class NoPort(Error, code="EZS831", name="no-port"):
    """A parameter whose name no port can have."""

    title = "no port of BehaviorTree.CPP can be called `{spelled}`"
    note = "a port begins with a letter from a to z, and is neither `name` nor `ID`"
    help = "rename the parameter"
    spelled: str


class TakenName(Error, code="EZS832", name="taken-name"):
    """A skill that is called like a node that BehaviorTree.CPP has."""

    title = "BehaviorTree.CPP has a node `{spelled}` of its own"
    help = "rename the skill or its implementation"
    spelled: str


class NoLiteral(Error, code="EZS833", name="no-literal"):
    """A value that means something else, or nothing, as the text of a port."""

    title = "BehaviorTree.CPP does not take {text} for what it is"
    note = "{why}"
    help = "pass a parameter of the skill instead"
    text: str
    why: str


class LimitTooLarge(Error, code="EZS834", name="limit-too-large"):
    """A count, or a time, beyond what BehaviorTree.CPP can count."""

    title = "BehaviorTree.CPP cannot count to the limit of this {decorator}"
    note = "it has 31 bits for tries, and 32 for milliseconds"
    help = "name a smaller limit"
    decorator: str


class CallsItself(Error, code="EZS835", name="calls-itself"):
    """A compound skill that is a part of itself."""

    title = "`{skill}` is a part of itself, which BehaviorTree.CPP cannot load"
    help = "write a loop as `self.retry(...)`, or a smaller `--depth`"
    skill: str


class SeveralTrees(Warning, code="EZS836", name="several-trees"):
    """A compound skill inside another that has more than one tree."""

    title = "`{skill}` has several trees: it stays one action"
    note = "which of them runs is decided when it is started; XML for BehaviorTree.CPP names one"
    skill: str


class ComputedLimit(Error, code="EZS837", name="computed-limit"):
    """A limit that Python computes, or converts, when the skill is started."""

    title = "BehaviorTree.CPP cannot compute the limit of this {decorator}"
    note = "its blackboard passes values on as they are, and its `Timeout` counts milliseconds"
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
