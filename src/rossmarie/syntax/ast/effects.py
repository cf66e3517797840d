"""The effects in the body of an action. Times are expressions whose type is not checked yet.

`topic` is a topic as written, or its alias; services, action servers, controller managers and nodes
are named in the same way.
"""

from __future__ import annotations

from dataclasses import dataclass

from dslkit.source import Span
from rossmarie.syntax.ast.expressions import Expression, Name, Number, Text, Unit


@dataclass(frozen=True)
class Position:
    """`[0]` or `["elbow"]` in a path."""

    index: int | str
    span: Span


@dataclass(frozen=True)
class FieldPath:
    """`linear.x`, `poses[0].position.x`: a field of a message."""

    steps: tuple[Name | Position, ...]
    span: Span


@dataclass(frozen=True)
class Target:
    """`/cmd_vel : geometry_msgs/Twist`. Without a type, another statement gives it."""

    name: Name
    type: Name | None
    span: Span


# --- commands that pass through the safety filter --------------------------------------------


@dataclass(frozen=True)
class FieldBound:
    """`linear.x in [-0.2, 0.2] m/s`."""

    path: FieldPath
    range: Expression
    span: Span


@dataclass(frozen=True)
class Limit:
    """`limit /cmd_vel { linear.x in [-0.2, 0.2] m/s; } ramp 0.3 m/s^2`."""

    target: Target
    bounds: tuple[FieldBound, ...]
    ramps: tuple[Expression, ...]
    span: Span


@dataclass(frozen=True)
class Scale:
    """`scale /cmd_vel by 50 % ramp 20 %/s`."""

    target: Target
    factor: Expression
    ramps: tuple[Expression, ...]
    span: Span


@dataclass(frozen=True)
class Block:
    """`block /cmd_vel ramp 0.3 m/s^2`."""

    target: Target
    ramps: tuple[Expression, ...]
    span: Span


# --- messages --------------------------------------------------------------------------------


@dataclass(frozen=True)
class FieldAssignment:
    """`data = true`; a list of values is a `Bracket`."""

    path: FieldPath
    value: Expression
    span: Span


@dataclass(frozen=True)
class Publish:
    """`publish /alarm : std_msgs/Bool { data = true; } at 2 Hz`; without a rate, one message."""

    target: Target
    assignments: tuple[FieldAssignment, ...]
    rate: Expression | None
    span: Span


@dataclass(frozen=True)
class Retrace:
    """`retrace eePose on /target : geometry_msgs/Point { ... } up to 100 apart 1 cm at 5 Hz`."""

    pose: Expression
    target: Target
    assignments: tuple[FieldAssignment, ...]
    most: Number
    apart: tuple[Expression, ...]
    rate: Expression
    span: Span


@dataclass(frozen=True)
class CallService:
    """`call /arm/lock : std_srvs/SetBool { data = true; } within 1 sec else stop`."""

    target: Target
    assignments: tuple[FieldAssignment, ...]
    timeout: Expression | None
    otherwise: Name | None
    span: Span


@dataclass(frozen=True)
class SetParameter:
    """`set /planner.max_vel_x in m/s to 0.2 m/s within 1 sec else stop`."""

    node: Name
    parameter: tuple[Name, ...]
    unit: Unit | None
    value: Expression
    timeout: Expression | None
    otherwise: Name | None
    span: Span


@dataclass(frozen=True)
class SwitchControllers:
    """`switch /controller_manager { stop effort; start position; } within 1 sec else stop`."""

    manager: Name
    start: tuple[Name, ...]
    stop: tuple[Name, ...]
    timeout: Expression | None
    otherwise: Name | None
    span: Span


# --- goals of action servers -----------------------------------------------------------------


@dataclass(frozen=True)
class SendGoal:
    """`send my_msgs/Retract { ... } to /arm within 5 sec then resend else stop`; `interrupted` is
    the word after `then`.
    """

    target: Target
    assignments: tuple[FieldAssignment, ...]
    timeout: Expression | None
    interrupted: Name | None
    otherwise: Name | None
    span: Span


@dataclass(frozen=True)
class CancelGoal:
    """`cancel /arm confirm by CONDITION within 0.5 sec then drop else stop`."""

    server: Name
    confirmation: Expression | None
    timeout: Expression | None
    interrupted: Name | None
    otherwise: Name | None
    span: Span


# --- behavior trees --------------------------------------------------------------------------


@dataclass(frozen=True)
class Passed:
    """`doing Drive.Target`: the parameter of a skill that runs at the start of the tree."""

    skill: Name
    parameter: Name
    span: Span


@dataclass(frozen=True)
class TreeArgument:
    """`Target: "kitchen"`, `Target: doing Drive.Target`."""

    parameter: Name
    value: Expression | Passed
    span: Span


@dataclass(frozen=True)
class RunTree:
    """`tree Reroute(Target: doing Drive.Target) within 20 sec then resume else stop`; `afterwards`
    is the word after `then`.
    """

    skill: Name
    arguments: tuple[TreeArgument, ...]
    timeout: Expression | None
    afterwards: Name | None
    otherwise: Name | None
    span: Span


# --- texts for people, and other effects -------------------------------------------------


@dataclass(frozen=True)
class Log:
    """`log warning "slow on the slope"`."""

    level: Name
    text: Text
    span: Span


@dataclass(frozen=True)
class Diagnose:
    """`diagnose error "too steep"`."""

    level: Name
    text: Text
    span: Span


@dataclass(frozen=True)
class Hook:
    """`hook retract_arm`."""

    name: Name
    span: Span


@dataclass(frozen=True)
class Reset:
    """`reset`."""

    span: Span


Effect = (
    Limit
    | Scale
    | Block
    | Publish
    | Retrace
    | CallService
    | SetParameter
    | SwitchControllers
    | SendGoal
    | CancelGoal
    | RunTree
    | Log
    | Diagnose
    | Hook
    | Reset
)

Awaited = CallService | SetParameter | SwitchControllers | SendGoal | CancelGoal | RunTree
"""The effects whose end the node awaits. They may fail."""
