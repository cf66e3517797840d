"""Checked effects of actions: names are resolved, and numbers are in the units of messages.

Topics and resources are names, confirmations are expressions; `lowering` replaces them by indices
of the machine. Message data use the types of `ir.reactions`. Effects that need no further data are
nodes of the syntax tree.
"""

from __future__ import annotations

from dataclasses import dataclass

from dslkit.source import Span
from rossmarie.ir import reactions
from rossmarie.syntax import ast


@dataclass(frozen=True)
class CheckedLimit:
    """Bounds on the fields of a command, by field number: from a limit or a block."""

    topic: str
    bounds: tuple[reactions.Bound, ...]


@dataclass(frozen=True)
class CheckedScale:
    """A factor on all fields of a command."""

    topic: str
    factor: float
    ramp: float | None


@dataclass(frozen=True)
class CheckedPublish:
    """A message."""

    topic: str
    message_type: str
    assignments: tuple[reactions.Assignment, ...]
    period_ns: int | None


@dataclass(frozen=True)
class CheckedRetrace:
    """Poses that a rule sends back. `numbers` are the fields of the message for the numbers of a
    pose.
    """

    pose: ast.Expression
    topic: str
    message_type: str
    assignments: tuple[reactions.Assignment, ...]
    numbers: tuple[reactions.FieldPath, ...]
    period_ns: int
    most: int
    apart: float
    apart_ns: int


@dataclass(frozen=True)
class CheckedCall:
    """A call of a service."""

    service: str
    service_type: str
    assignments: tuple[reactions.Assignment, ...]
    timeout_ns: int


@dataclass(frozen=True)
class CheckedParameter:
    """A new value of a parameter."""

    node: str
    parameter: str
    value: reactions.Scalar
    timeout_ns: int


@dataclass(frozen=True)
class CheckedSwitch:
    """A switch of controllers."""

    manager: str
    start: tuple[str, ...]
    stop: tuple[str, ...]
    timeout_ns: int


@dataclass(frozen=True)
class CheckedGoal:
    """A goal for an action server."""

    server: str
    action_type: str
    assignments: tuple[reactions.Assignment, ...]
    timeout_ns: int
    interrupted: reactions.Interrupted


@dataclass(frozen=True)
class CheckedCancel:
    """The cancellation of all goals of an action server."""

    server: str
    action_type: str | None
    confirmation: ast.Expression | None
    timeout_ns: int
    interrupted: reactions.Interrupted


Awaited = CheckedCall | CheckedParameter | CheckedSwitch | CheckedGoal | CheckedCancel
Checked = (
    CheckedLimit | CheckedScale | CheckedPublish | CheckedRetrace | Awaited
    | ast.Log | ast.Diagnose | ast.Hook | ast.Reset
)  # fmt: skip


@dataclass(frozen=True)
class CheckedEffect:
    """An effect with its place. `command` is the topic that has to pass through the safety filter
    for this effect, `resource` the resource that the effect needs exclusively, `otherwise` the
    action that follows a failure.
    """

    effect: Checked
    span: Span
    command: str | None = None
    resource: str | None = None
    otherwise: str | None = None

    @property
    def may_fail(self) -> bool:
        """Say whether the effect can fail and lead to an escalation. An effect without an exclusive
        resource always succeeds.
        """
        return self.resource is not None
