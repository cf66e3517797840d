"""ROSS5xx: features that a target, or any target, does not support."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class MonitorTooLarge(Error, code="ROSS501", name="monitor-too-large"):
    """More conditions, rules and limits than the generated code can number."""

    title = "these rules are too large for one {target} monitor"
    label = "with this rule there are {found} {what}; a monitor holds up to {most}"
    note = "a monitor uses 16-bit indexes for its tables, to keep the tables small"
    help = "split the rules into several files: each file becomes a monitor of its own"
    target: str
    what: str
    found: int
    most: int


class TooManyEvaluations(Error, code="ROSS502", name="too-many-evaluations"):
    """Timers that can expire too often, one after another, before one message."""

    title = "these rules could need more than {most} evaluations in one call of their monitor"
    label = "with this timer, which can expire {often}, there are {found}"
    note = (
        "a call first evaluates the rules once for each instant at which a timer expired since the "
        "last call; the timer of a `for` expires each time its condition becomes true, so each "
        "`for` around another `for` can double the number"
    )
    help = (
        "use fewer `for` inside the conditions of other `for`, or split the rules into several "
        "files: each file becomes a monitor of its own"
    )
    often: str
    found: int
    most: int


class UnsupportedEffect(Error, code="ROSS503", name="unsupported-effect"):
    """An effect of an action that a target cannot carry out."""

    title = "the target {target} cannot carry out `{effect}`"
    label = "{reason}"
    note = "a node without this effect would do less than the rules demand"
    target: str
    effect: str
    reason: str

    class StateType(Remark):
        says = "declare the type in a system model, `server {server} : PACKAGE/TYPE;`"
        server: str

    class OtherParameter(Remark):
        says = "name a parameter that the node has in ROS 1, or set the parameter in a `hook`"


class NothingToDo(Error, code="ROSS504", name="nothing-to-do"):
    """Rules whose actions all have no body."""

    title = "a node of the target {target} would have nothing to do"
    label = "no action of this rule or of another rule has a body"
    note = "a node carries out the bodies of actions; the target `c99` generates only the monitor"
    help = "write the effects of an action: `action stop {{ block /cmd_vel; }}`, or at least `log`"
    target: str


ALL: tuple[type[Template], ...] = (
    MonitorTooLarge,
    TooManyEvaluations,
    UnsupportedEffect,
    NothingToDo,
)
