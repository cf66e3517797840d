"""ROSS5xx: features that a target, or any target, does not support."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class MonitorTooLarge(Error, code="ROSS501", name="monitor-too-large"):
    """More conditions, rules and limits than the generated code can number."""

    title = "these rules are too large for one {target} monitor"
    label = "with this rule there are {found} {what}; a monitor holds up to {most}"
    note = "the tables of a monitor are indexed by 16 bits, so that they stay small"
    help = "split the rules over several files: each becomes a monitor of its own"
    target: str
    what: str
    found: int
    most: int


class TooManyEvaluations(Error, code="ROSS502", name="too-many-evaluations"):
    """Timers that can expire too often, one after another, before one message."""

    title = "these rules could take more than {most} evaluations in one call of their monitor"
    label = "with this timer, which can fall due {often}, there are {found}"
    note = (
        "a call first evaluates the rules at each instant at which a timer fell due since the last "
        "call; that of a `for` does each time that its condition becomes true, so that each `for` "
        "around others can double the number"
    )
    help = (
        "use fewer `for` inside the conditions of others, or split the rules over several files: "
        "each becomes a monitor of its own"
    )
    often: str
    found: int
    most: int


class UnsupportedEffect(Error, code="ROSS503", name="unsupported-effect"):
    """An effect of an action that a target cannot carry out."""

    title = "the target {target} cannot do `{effect}`"
    label = "{reason}"
    note = "a node that left it out would do less than these rules say"
    target: str
    effect: str
    reason: str

    class StateType(Remark):
        says = "say it in a system model, `server {server} : PACKAGE/TYPE;`"
        server: str

    class OtherParameter(Remark):
        says = "name a parameter that the node has in ROS 1, or do it in a `hook`"


class NothingToDo(Error, code="ROSS504", name="nothing-to-do"):
    """Rules whose actions all have no body."""

    title = "a node of the target {target} would have nothing to do"
    label = "neither the actions of this rule nor those of others have a body"
    note = "a node carries out what stands in the bodies of actions; the monitor alone is `c99`"
    help = "say what an action does: `action stop {{ block /cmd_vel; }}`, or at least `log`"
    target: str


ALL: tuple[type[Template], ...] = (
    MonitorTooLarge,
    TooManyEvaluations,
    UnsupportedEffect,
    NothingToDo,
)
