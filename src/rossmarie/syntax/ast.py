"""What the user wrote, as a tree. Every node remembers its span; nothing is resolved or checked.

Comes out of `parse`; goes into `check` and `format`. `Broken` stands where text could not be
parsed: the finding is already reported and later stages pass over it in silence.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass

from dslkit.source import SourceFile, Span


@dataclass(frozen=True)
class Name:
    """A name as written: an identifier, a topic (`/imu/data`) or a type (`sensor_msgs/Imu`)."""

    text: str
    span: Span


@dataclass(frozen=True)
class Unit:
    """A unit as written behind a number, `m/s`; not yet known to exist."""

    text: str
    span: Span


# --- expressions -----------------------------------------------------------------------------


class UnaryOperator(enum.Enum):
    """The prefix operators."""

    NOT = "not"
    NEGATE = "-"


class BinaryOperator(enum.Enum):
    """The infix operators; the value is the spelling."""

    OR = "or"
    AND = "and"
    EQUAL = "=="
    NOT_EQUAL = "!="
    LESS = "<"
    LESS_OR_EQUAL = "<="
    GREATER = ">"
    GREATER_OR_EQUAL = ">="
    ADD = "+"
    SUBTRACT = "-"
    MULTIPLY = "*"
    DIVIDE = "/"


JUNCTIONS = frozenset({BinaryOperator.AND, BinaryOperator.OR})
"""The operators between conditions."""


@dataclass(frozen=True)
class Number:
    """`4.0 sec`, `-15 N`, `3`."""

    value: float
    unit: Unit | None
    span: Span


@dataclass(frozen=True)
class Boolean:
    """`true` or `false`."""

    value: bool
    span: Span


@dataclass(frozen=True)
class Text:
    """`"docked"`."""

    value: str
    span: Span


@dataclass(frozen=True)
class Bracket:
    """`[-10, 10] deg`: an interval (2 numbers) or a box (6: min and max per axis)."""

    elements: tuple[Expression, ...]
    unit: Unit | None
    span: Span


@dataclass(frozen=True)
class Reference:
    """A name used as a value."""

    name: Name
    span: Span


@dataclass(frozen=True)
class Member:
    """`force.z`, `imu.steep`."""

    value: Expression
    member: Name
    span: Span


@dataclass(frozen=True)
class Index:
    """`pose.covariance[0]`."""

    value: Expression
    index: int
    span: Span


@dataclass(frozen=True)
class Call:
    """`norm(v)` or `orientation.pitch()`; the receiver of a method call is its first argument."""

    function: Name
    arguments: tuple[Expression, ...]
    is_method: bool
    span: Span


@dataclass(frozen=True)
class Oscillates:
    """`oscillates(x, 3 times, within 0.25 sec, by 5 N)`; `swing` is the part behind `by`."""

    value: Expression
    count: Number
    window: Expression
    swing: Expression | None
    span: Span


@dataclass(frozen=True)
class Unary:
    """A prefix operator and its operand."""

    operator: UnaryOperator
    operand: Expression
    span: Span


@dataclass(frozen=True)
class Binary:
    """An infix operator and its operands."""

    operator: BinaryOperator
    left: Expression
    right: Expression
    span: Span


@dataclass(frozen=True)
class Membership:
    """`x in range`, `x not in range`."""

    value: Expression
    container: Expression
    is_negated: bool
    span: Span


@dataclass(frozen=True)
class Held:
    """`condition for 4.0 sec`."""

    condition: Expression
    duration: Expression
    span: Span


@dataclass(frozen=True)
class Parenthesized:
    """`(x)`; kept so that the formatter can keep it."""

    inner: Expression
    span: Span


@dataclass(frozen=True)
class Broken:
    """Text that could not be parsed; already reported."""

    span: Span


Expression = (
    Number
    | Boolean
    | Text
    | Bracket
    | Reference
    | Member
    | Index
    | Call
    | Oscillates
    | Unary
    | Binary
    | Membership
    | Held
    | Parenthesized
    | Broken
)


# --- declarations ----------------------------------------------------------------------------


@dataclass(frozen=True)
class Import:
    """`import "husky_system.ross";` -- the path is relative to the importing file."""

    path: Text
    span: Span


@dataclass(frozen=True)
class TopicDeclaration:
    """`topic Wrench = /ft/wrench : geometry_msgs/Wrench;` -- alias and unit are optional."""

    alias: Name | None
    topic: Name
    message_type: Name
    unit: Unit | None
    span: Span


@dataclass(frozen=True)
class NodeDeclaration:
    """`node planner { publishes /cmd_vel; subscribes /odom; }`."""

    name: Name
    publishes: tuple[Name, ...]
    subscribes: tuple[Name, ...]
    span: Span


@dataclass(frozen=True)
class UnitDeclaration:
    """`unit my_msgs/Wheel.speed = rad/s;` -- the unit of a message field."""

    message_type: Name
    path: tuple[Name, ...]
    unit: Unit
    span: Span


@dataclass(frozen=True)
class MessagesDeclaration:
    """`messages "msg";` -- a folder of .msg files, relative to the declaring file."""

    path: Text
    span: Span


SystemMember = TopicDeclaration | NodeDeclaration | UnitDeclaration | MessagesDeclaration


@dataclass(frozen=True)
class System:
    """`system husky { ... }` -- a system model: what topics there are, and of what type."""

    name: Name
    members: tuple[SystemMember, ...]
    documentation: str | None
    span: Span


@dataclass(frozen=True)
class Action:
    """`action lowSpeed;` -- `body` is the span of the reserved `{ ... }`, if there is one."""

    name: Name
    body: Span | None
    documentation: str | None
    span: Span


@dataclass(frozen=True)
class Constant:
    """`const maxSpeed = 0.5 m/s`."""

    name: Name
    value: Expression
    documentation: str | None
    span: Span


@dataclass(frozen=True)
class Input:
    """`input pitch = topic /imu/data : sensor_msgs/Imu .orientation in rad timeout 0.2 sec`.

    In the printed form `topic Wrench.force` the topic is a plain name and `message_type` is None:
    a system model knows it.
    """

    name: Name
    topic: Name
    message_type: Name | None
    path: tuple[Name, ...]
    unit: Unit | None
    timeout: Expression | None
    documentation: str | None
    span: Span


@dataclass(frozen=True)
class Condition:
    """`steep : pitch not in [-20, 20] deg for 4.0 sec;` inside an entity."""

    name: Name
    expression: Expression
    documentation: str | None
    span: Span


@dataclass(frozen=True)
class Entity:
    """`entity imu { ... }`: named conditions that belong together."""

    name: Name
    conditions: tuple[Condition, ...]
    documentation: str | None
    span: Span


@dataclass(frozen=True)
class ClearWhen:
    """`clear when COND`: released once the rule's condition is false and COND is true."""

    condition: Expression
    span: Span


@dataclass(frozen=True)
class ClearFor:
    """`clear for 2.0 sec`: released once the rule's condition has been false for that long."""

    duration: Expression
    span: Span


@dataclass(frozen=True)
class LatchedUntilReset:
    """`latched until reset`: released by an operator, while the rule's condition is false."""

    span: Span


ResumeContract = ClearWhen | ClearFor | LatchedUntilReset


@dataclass(frozen=True)
class Rule:
    """`rule NAME: if COND then { ACTION; ... } CONTRACT;` -- name and contracts are optional.

    More than one contract is reported by the checker.
    """

    name: Name | None
    condition: Expression
    actions: tuple[Name, ...]
    contracts: tuple[ResumeContract, ...]
    documentation: str | None
    span: Span


Item = Import | System | Action | Constant | Input | Entity | Rule


@dataclass(frozen=True)
class Module:
    """One parsed file. `is_whole` is False if it could not be read to its end: then nobody knows
    what it declares.
    """

    file: SourceFile
    items: tuple[Item, ...]
    is_whole: bool = True
