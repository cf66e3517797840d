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
    """Two parameters that are one for SkiROS2."""

    title = "`{parameter}` has the key {key}, which another parameter has"
    note = "SkiROS2 silently takes the last declaration of a key"
    help = "give one of them another key"
    parameter: str
    key: str

    class First(Remark):
        says = "so has `{parameter}`"
        parameter: str


class WrongKey(Error, code="EZS008", name="wrong-key"):
    """A key that is no text, is empty, or is not the only one."""

    title = "the key of `{parameter}` is not one text"
    help = 'write `{parameter}: Annotated[..., Key("Start Pose")]`'
    parameter: str


class WrongOutput(Error, code="EZS009", name="wrong-output"):
    """An output that is asked for before the skill, or gets its value from elsewhere."""

    title = "`{parameter}` is an output, and {reason}"
    note = "an output has no value before the skill, which gives it one"
    help = "write `{parameter}: OUTPUT[{type}]`"
    parameter: str
    reason: str
    type: str

    class AskedBefore(Remark):
        says = "say it as a post-condition, or declare `{parameter}` without OUTPUT"
        parameter: str


class RobotAsValue(Error, code="EZS217", name="robot-as-value"):
    """A parameter with the name of the robot that is no thing."""

    title = "`Robot` is the robot that runs the skill, and this is {found}"
    label = "a name that SkiROS2 gives the robot"
    note = (
        "SkiROS2 gives each skill a parameter `Robot`; siblings with that name would get the value"
    )
    help = "write `Robot: cora.Robot`, or give the parameter another name"
    found: str


ALL: tuple[type[Template], ...] = (NoBrackets, DuplicateKey, WrongKey, WrongOutput, RobotAsValue)
