"""Reactions: what active rules do to the robot. A machine of its own, beside the monitor machine.

The monitor machine (`model.py`) says which rules are active. This one says what follows: which
bounds lie on which command topic, which task runs, and what is undone on release. It decides; the
node around it performs (publishes, calls, sends goals) and reports what came of it.
The meaning is written down in `docs/explanation/reactions.md` (R1, R2, ...).

All numbers are in the units of the messages that they go into.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass

from dslkit.source import Span

FieldPath = tuple[str | int, ...]


@dataclass(frozen=True)
class CommandField:
    """A floating-point number of a command, or with `is_array` the elements of an array of them."""

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
    """While in force the field stays in `[low, high]`, which contains 0. After release the ends
    move apart by `ramp` per second; None: they are lifted at once.
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
    """`scale /cmd_vel by 50 %`: every field is multiplied by `factor` (0 to 1); after release the
    factor grows by `ramp` per second, up to 1; None: it is 1 at once.
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
    of the command topic if the topic passes through the filter: then this takes its place.
    """

    topic: str
    message_type: str
    assignments: tuple[Assignment, ...]
    period_ns: int | None
    command: int | None


@dataclass(frozen=True)
class Retrace:
    """`retrace INPUT on TOPIC : TYPE { ... } at RATE`: poses of a memory, the newest first (R17).
    `numbers` are the fields of the message that the numbers of a pose go into, in their order.
    """

    topic: str
    message_type: str
    assignments: tuple[Assignment, ...]
    numbers: tuple[FieldPath, ...]
    period_ns: int
    memory: int


@dataclass(frozen=True)
class Call:
    """`call SERVICE : TYPE { ... } within D`. Fails if the answer has a field `success` that is
    false, or does not come in time.
    """

    service: str
    service_type: str
    assignments: tuple[Assignment, ...]
    timeout_ns: int


@dataclass(frozen=True)
class SetParameter:
    """`set NODE.PARAMETER to VALUE within D`; the old value comes back on release."""

    node: str
    parameter: str
    value: Scalar
    timeout_ns: int


@dataclass(frozen=True)
class SwitchControllers:
    """`switch MANAGER { start A; stop B; } within D`; switched back on release."""

    manager: str
    start: tuple[str, ...]
    stop: tuple[str, ...]
    timeout_ns: int


class Interrupted(enum.Enum):
    """The fate of the goal that was interrupted, on release."""

    DROP = "drop"
    RESEND = "resend"


@dataclass(frozen=True)
class SendGoal:
    """`send TYPE { ... } to SERVER within D then resend`: cancels the goal at hand first."""

    server: str
    action_type: str
    assignments: tuple[Assignment, ...]
    timeout_ns: int
    interrupted: Interrupted


@dataclass(frozen=True)
class CancelGoal:
    """`cancel SERVER confirm by COND within D then resend`. `confirmation` is an index of
    `Machine.watches`; None: the server's word is enough.
    """

    server: str
    action_type: str | None
    confirmation: int | None
    timeout_ns: int
    interrupted: Interrupted


class Level(enum.Enum):
    """The severity of a log line or diagnosis."""

    DEBUG = "debug"  # logs only
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
    """`diagnose LEVEL TEXT`: a status in the diagnostics for as long as it is in force."""

    level: Level
    text: str


@dataclass(frozen=True)
class Hook:
    """`hook NAME`: a function of the user's, called at the start and at the end."""

    name: str


@dataclass(frozen=True)
class Reset:
    """`reset`: what an operator's reset of all latched rules does (S38)."""


Awaited = Call | SetParameter | SwitchControllers | SendGoal | CancelGoal
"""Effects whose end is awaited for a time."""

Effect = Limit | Scale | Publish | Retrace | Awaited | Log | Diagnose | Hook | Reset


POSES = (3, 7)
"""The numbers of a position, and of a position and a quaternion."""


# --- plans -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Task:
    """One effect of one action at one place in the plan of one rule.

    `resource` is the index of what it needs for itself, None if it shares. `otherwise` are the
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
    """The plan of a rule: stages one after the other; the tasks of a stage side by side.

    `tasks` are all of it in the order in which they stand in the file, escalations included. It is
    not carried out while one of the rules `unless` is active.
    """

    stages: tuple[tuple[int, ...], ...]
    tasks: tuple[int, ...]
    unless: tuple[int, ...] = ()


@dataclass(frozen=True)
class Memory:
    """A memory of at most `most` poses (R16), each at least `apart` m from the one before it and
    `apart_ns` later. `readings` are indexes of `Machine.readings`; the first three are a position.
    """

    readings: tuple[int, ...]
    most: int
    apart: float
    apart_ns: int


@dataclass(frozen=True)
class Reactions:
    """The reactions of the rules of a machine. `plans` has one entry for each rule; `order` are the
    rules from the first to the last that gets a resource that several need; `priorities` are the
    pairs of rules of which the first was put over the second; `memories` are those of poses.
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
    """The time for which the end of an effect is awaited; None if nothing is."""
    match effect:
        case Call() | SetParameter() | SwitchControllers() | SendGoal() | CancelGoal():
            return effect.timeout_ns
        case (
            Limit() | Scale() | Publish() | Retrace() | Log() | Diagnose() | Hook() | Reset()
        ):  # fmt: skip
            return None


def is_lasting(effect: Effect) -> bool:
    """Say whether an effect stays in force after it is done, so that something is undone on
    release.
    """
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
    """Say whether a limit lets nothing of a command pass but zero."""
    is_zero = all(bound.low == 0 == bound.high for bound in effect.bounds)
    return is_zero and len(effect.bounds) == len(command.fields)


@dataclass(frozen=True)
class Target:
    """The target that an effect needs for itself: `controller manager /controller_manager`. `name`
    is the ROS name; a parameter is distinguished by its own behind that.
    """

    kind: str
    name: str
    parameter: str = ""

    def __str__(self) -> str:
        return f"{self.kind} {self.name}{self.parameter}"


def target_of(effect: Effect) -> Target | None:
    """The target that an effect needs for itself; None if it shares (R2)."""
    match effect:
        case Publish(topic=topic) | Retrace(topic=topic):
            return Target("topic", topic)
        case Call(service=service):
            return Target("service", service)
        case SetParameter(node=node, parameter=parameter):
            return Target("parameter", node, f".{parameter}")
        case SwitchControllers(manager=manager):
            return Target("controller manager", manager)
        case SendGoal(server=server) | CancelGoal(server=server):
            return Target("action server", server)
        case Limit() | Scale() | Log() | Diagnose() | Hook() | Reset():
            return None


def waits(effect: Effect) -> bool:
    """Say whether an effect waits for its resource while another rule has it; others fail then."""
    match effect:
        case Publish(period_ns=period_ns):
            return period_ns is not None
        case Retrace() | SetParameter() | SwitchControllers() | CancelGoal():
            return True
        case Limit() | Scale() | Call() | SendGoal() | Log() | Diagnose() | Hook() | Reset():
            return False


def confirmation(effect: Effect) -> int | None:
    """The index in `Machine.watches` of what has to be true before an effect has succeeded."""
    match effect:
        case CancelGoal():
            return effect.confirmation
        case (
            Limit() | Scale() | Publish() | Retrace() | Call() | SetParameter()
            | SwitchControllers() | SendGoal() | Log() | Diagnose() | Hook() | Reset()
        ):  # fmt: skip
            return None
