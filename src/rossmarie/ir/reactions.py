"""Reactions: the effects of active rules on the robot. A separate machine beside the monitor
machine.

The monitor machine (`model.py`) determines the active rules. This machine determines the
consequences: the bounds on command topics, the running tasks, and the effects to undo on release.
It only decides. The node around it performs the effects (publishes, calls, sends goals) and reports
their results. `docs/explanation/reactions.md` defines the meaning (R1, R2, ...).

All numbers are in the units of the messages that contain them.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass

from dslkit.source import Span

FieldPath = tuple[str | int, ...]


@dataclass(frozen=True)
class CommandField:
    """A floating-point number of a command; with `is_array`, the elements of an array of
    numbers.
    """

    path: FieldPath
    is_array: bool
    unit: str


@dataclass(frozen=True)
class CommandTopic:
    """A topic whose messages pass through the safety filter. `fields` are all of its
    floating-point numbers outside of headers.
    """

    topic: str
    message_type: str
    fields: tuple[CommandField, ...]
    span: Span


# --- effects ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class Bound:
    """While in force, a bound keeps the field in `[low, high]`, which contains 0. After release the
    ends move apart by `ramp` per second; if `ramp` is None, the bound is lifted at once.
    """

    field: int
    low: float
    high: float
    ramp: float | None


@dataclass(frozen=True)
class Limit:
    """`limit /cmd_vel { ... }`; `block` is a limit of every field to `[0, 0]`."""

    topic: int
    bounds: tuple[Bound, ...]


@dataclass(frozen=True)
class Scale:
    """`scale /cmd_vel by 50 %`: every field is multiplied by `factor` (0 to 1). After release the
    factor grows by `ramp` per second, up to 1; if `ramp` is None, it is 1 at once.
    """

    topic: int
    factor: float
    ramp: float | None


Scalar = bool | float | str


@dataclass(frozen=True)
class Assignment:
    """A field of a message to be sent, in the unit of the message."""

    path: FieldPath
    value: Scalar | tuple[Scalar, ...]


@dataclass(frozen=True)
class Publish:
    """`publish TOPIC : TYPE { ... } at RATE`; once if `period_ns` is None. `command` is the index
    of the command topic if the topic passes through the filter: then the message replaces the
    command.
    """

    topic: str
    message_type: str
    assignments: tuple[Assignment, ...]
    period_ns: int | None
    command: int | None


@dataclass(frozen=True)
class Retrace:
    """`retrace INPUT on TOPIC : TYPE { ... } at RATE`: poses of a memory, the newest first (R17).
    `numbers` are the fields of the message for the numbers of a pose, in their order.
    """

    topic: str
    message_type: str
    assignments: tuple[Assignment, ...]
    numbers: tuple[FieldPath, ...]
    period_ns: int
    memory: int


@dataclass(frozen=True)
class Call:
    """`call SERVICE : TYPE { ... } within D`. The call fails if the answer arrives too late, or has
    a field `success` that is false.
    """

    service: str
    service_type: str
    assignments: tuple[Assignment, ...]
    timeout_ns: int


@dataclass(frozen=True)
class SetParameter:
    """`set NODE.PARAMETER to VALUE within D`. Release restores the old value."""

    node: str
    parameter: str
    value: Scalar
    timeout_ns: int


@dataclass(frozen=True)
class SwitchControllers:
    """`switch MANAGER { start A; stop B; } within D`. Release switches the controllers back."""

    manager: str
    start: tuple[str, ...]
    stop: tuple[str, ...]
    timeout_ns: int


class Interrupted(enum.Enum):
    """The treatment of the interrupted goal on release."""

    DROP = "drop"
    RESEND = "resend"


@dataclass(frozen=True)
class SendGoal:
    """`send TYPE { ... } to SERVER within D then resend`. The effect first cancels the current
    goal.
    """

    server: str
    action_type: str
    assignments: tuple[Assignment, ...]
    timeout_ns: int
    interrupted: Interrupted


@dataclass(frozen=True)
class CancelGoal:
    """`cancel SERVER confirm by COND within D then resend`. `confirmation` is an index of
    `Machine.watches`; None if the server's reply is enough.
    """

    server: str
    action_type: str | None
    confirmation: int | None
    timeout_ns: int
    interrupted: Interrupted


class Level(enum.Enum):
    """The severity of a log line or diagnosis."""

    DEBUG = "debug"  # the level logs only
    INFORMATION = "info"
    WARNING = "warning"
    ERROR = "error"


@dataclass(frozen=True)
class Log:
    """`log LEVEL TEXT`, once."""

    level: Level
    text: str


@dataclass(frozen=True)
class Diagnose:
    """`diagnose LEVEL TEXT`: a status in the diagnostics while the effect is in force."""

    level: Level
    text: str


@dataclass(frozen=True)
class Hook:
    """`hook NAME`: a function of the user, called at the start and at the end."""

    name: str


@dataclass(frozen=True)
class Reset:
    """`reset`: like an operator's reset of all latched rules (S38)."""


Awaited = Call | SetParameter | SwitchControllers | SendGoal | CancelGoal
"""Effects whose end the node awaits, with a time limit."""

Effect = Limit | Scale | Publish | Retrace | Awaited | Log | Diagnose | Hook | Reset


POSES = (3, 7)
"""The number of values of a position, and of a position with a quaternion."""


# --- plans -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Task:
    """One effect of one action at one place in the plan of one rule.

    `resource` is the index of its exclusive resource; None if it needs none. `otherwise` are the
    tasks that start when it fails; they belong to no stage and may have an `otherwise` themselves.
    """

    action: int
    effect: Effect
    resource: int | None
    otherwise: tuple[int, ...]
    span: Span


@dataclass(frozen=True)
class Action:
    """A declared action."""

    name: str
    documentation: str | None
    span: Span


@dataclass(frozen=True)
class RecoveryPlan:
    """The plan of a rule: its stages follow each other; the tasks of a stage run side by side.

    `tasks` are all its tasks in file order, including escalations. The plan is not carried out
    while one of the rules `unless` is active.
    """

    stages: tuple[tuple[int, ...], ...]
    tasks: tuple[int, ...]
    unless: tuple[int, ...] = ()


@dataclass(frozen=True)
class Memory:
    """A memory of at most `most` poses (R16), each at least `apart` m from the pose before it and
    `apart_ns` later. `readings` are indexes of `Machine.readings`; the first three are a position.
    """

    readings: tuple[int, ...]
    most: int
    apart: float
    apart_ns: int


@dataclass(frozen=True)
class Reactions:
    """The reactions of the rules of a machine. `plans` has one entry for each rule. `order` lists
    the rules in the order in which they get a resource that several rules need. `priorities` are
    the pairs of rules in which the user put the first rule over the second. `memories` are the
    memories of poses.
    """

    commands: tuple[CommandTopic, ...]
    actions: tuple[Action, ...]
    resources: tuple[str, ...]
    tasks: tuple[Task, ...]
    plans: tuple[RecoveryPlan, ...]
    order: tuple[int, ...]
    priorities: tuple[tuple[int, int], ...] = ()
    memories: tuple[Memory, ...] = ()


NO_REACTIONS = Reactions((), (), (), (), (), ())


# --- how effects behave ----------------------------------------------------------------------


def timeout_ns(effect: Effect) -> int | None:
    """The time in ns for which the node awaits the end of an effect; None if it does not await the
    end.
    """
    match effect:
        case Call() | SetParameter() | SwitchControllers() | SendGoal() | CancelGoal():
            return effect.timeout_ns
        case (
            Limit() | Scale() | Publish() | Retrace() | Log() | Diagnose() | Hook() | Reset()
        ):  # fmt: skip
            return None


def is_lasting(effect: Effect) -> bool:
    """Say whether an effect stays in force after it is done. Release has to undo such an effect."""
    match effect:
        case Publish(period_ns=period_ns):
            return period_ns is not None
        case SendGoal(interrupted=interrupted):
            return interrupted is Interrupted.RESEND
        case Call() | Log() | Reset():
            return False
        case (
            Limit() | Scale() | Retrace() | SetParameter() | SwitchControllers() | CancelGoal()
            | Diagnose() | Hook()
        ):  # fmt: skip
            return True


def is_block(command: CommandTopic, effect: Limit) -> bool:
    """Say whether a limit lets only zero pass for all fields of a command."""
    is_zero = all(bound.low == 0 == bound.high for bound in effect.bounds)
    return is_zero and len(effect.bounds) == len(command.fields)


@dataclass(frozen=True)
class ExclusiveTarget:
    """The target that an effect needs exclusively: `controller manager /controller_manager`. `name`
    is the ROS name; a parameter adds its own name.
    """

    kind: str
    name: str
    parameter: str = ""

    def __str__(self) -> str:
        return f"{self.kind} {self.name}{self.parameter}"


def target_of(effect: Effect) -> ExclusiveTarget | None:
    """The target that an effect needs exclusively; None if it needs none (R2)."""
    match effect:
        case Publish(topic=topic) | Retrace(topic=topic):
            return ExclusiveTarget("topic", topic)
        case Call(service=service):
            return ExclusiveTarget("service", service)
        case SetParameter(node=node, parameter=parameter):
            return ExclusiveTarget("parameter", node, f".{parameter}")
        case SwitchControllers(manager=manager):
            return ExclusiveTarget("controller manager", manager)
        case SendGoal(server=server) | CancelGoal(server=server):
            return ExclusiveTarget("action server", server)
        case Limit() | Scale() | Log() | Diagnose() | Hook() | Reset():
            return None


def waits(effect: Effect) -> bool:
    """Say whether an effect waits while another rule has its resource. Other effects fail in this
    case.
    """
    match effect:
        case Publish(period_ns=period_ns):
            return period_ns is not None
        case Retrace() | SetParameter() | SwitchControllers() | CancelGoal():
            return True
        case Limit() | Scale() | Call() | SendGoal() | Log() | Diagnose() | Hook() | Reset():
            return False


def confirmation(effect: Effect) -> int | None:
    """The index in `Machine.watches` of the proposition that confirms the success of an effect;
    None if there is none.
    """
    match effect:
        case CancelGoal():
            return effect.confirmation
        case (
            Limit() | Scale() | Publish() | Retrace() | Call() | SetParameter()
            | SwitchControllers() | SendGoal() | Log() | Diagnose() | Hook() | Reset()
        ):  # fmt: skip
            return None
