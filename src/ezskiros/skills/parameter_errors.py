"""EZS006 to EZS009, EZS217: markers, keys and outputs of parameters, and the robot."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class NoBrackets(Error, code="EZS006", name="no-brackets"):
    """`INFERRED(...)`, or `INFERRED` alone."""

    title = "`{marker}` needs a type in square brackets"
    help = "write `{meant}`"
    marker: str
    meant: str


class DuplicateKey(Error, code="EZS007", name="duplicate-key"):
    """Two parameters with the same SkiROS2 key."""

    title = "`{parameter}` has the key {key} of another parameter"
    note = "SkiROS2 silently uses the last declaration of a key"
    help = "give one of the parameters another key"
    parameter: str
    key: str

    class First(Remark):
        says = "`{parameter}` has the same key"
        parameter: str


class WrongKey(Error, code="EZS008", name="wrong-key"):
    """A key that is not a string, is empty, or is one of several."""

    title = "the key of `{parameter}` must be one string that is not empty"
    help = 'write `{parameter}: Annotated[..., Key("Start Pose")]`'
    parameter: str


class WrongOutput(Error, code="EZS009", name="wrong-output"):
    """An output that is used before the skill runs, or that has another source."""

    title = "`{parameter}` is an output, and {reason}"
    note = "an output has no value until the skill sets it"
    help = "write `{parameter}: OUTPUT[{type}]`"
    parameter: str
    reason: str
    type: str

    class AskedBefore(Remark):
        says = "make this a post-condition, or declare `{parameter}` without OUTPUT"
        parameter: str


class RobotAsValue(Error, code="EZS217", name="robot-as-value"):
    """A parameter named `Robot` that does not stand for an individual."""

    title = "`Robot` stands for the robot that runs the skill, but here it is {found}"
    label = "SkiROS2 uses this name for the robot"
    note = (
        "SkiROS2 gives each skill a parameter `Robot`; other children would get this value for it"
    )
    help = "write `Robot: cora.Robot`, or give the parameter another name"
    found: str


ALL: tuple[type[Template], ...] = (NoBrackets, DuplicateKey, WrongKey, WrongOutput, RobotAsValue)
