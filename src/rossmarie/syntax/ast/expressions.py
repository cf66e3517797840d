"""Names, units and expressions."""

from __future__ import annotations

import enum
from dataclasses import dataclass

from dslkit.source import Span


@dataclass(frozen=True)
class Name:
    """A name as written: an identifier, a topic (`/imu/data`) or a type (`sensor_msgs/Imu`)."""

    text: str
    span: Span


@dataclass(frozen=True)
class Unit:
    """A unit after a number, `m/s`, not checked yet."""

    text: str
    span: Span


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
    """`[-10, 10] deg`: an interval (2 numbers) or a box (6 numbers: minimum and maximum per axis).
    In a test also any number of elements, including none.
    """

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
    """`pose.covariance[0]`, `joints["elbow"]`, and `joints[elbow]` with a constant for the name of
    the element. In the last form, `constant` is set, and `index` is empty until the constant is
    looked up.
    """

    value: Expression
    index: int | str
    span: Span
    constant: Name | None = None


@dataclass(frozen=True)
class Arc:
    """`[-30 deg .. 30 deg]`: from one angle counter-clockwise to another."""

    first: Expression
    last: Expression
    span: Span


@dataclass(frozen=True)
class Sector:
    """`scan.ranges[-30 deg .. 30 deg]`: the readings of a scan between two angles."""

    value: Expression
    arc: Arc
    span: Span


@dataclass(frozen=True)
class Call:
    """`norm(v)` or `orientation.pitch()`; the receiver of a method call is its first argument."""

    function: Name
    arguments: tuple[Expression, ...]
    is_method: bool
    span: Span


@dataclass(frozen=True)
class Edges:
    """`edges of condition within 10 sec`, the argument of `count`; `window` is None if missing."""

    condition: Expression
    window: Expression | None
    span: Span


@dataclass(frozen=True)
class Oscillates:
    """`oscillates(x, 3 times, within 0.25 sec, by 5 N)`; `swing` is the part after `by`."""

    value: Expression
    count: Number
    window: Expression
    swing: Expression | None
    span: Span


@dataclass(frozen=True)
class ListFold:
    """`any(o in objects: o.size.x > 1 m)`: a function of the values of `body` for the elements of a
    list of messages; `variable` stands for an element.
    """

    function: Name
    variable: Name
    list: Expression
    body: Expression
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
class Since:
    """`held since begun`."""

    held: Expression
    begun: Expression
    span: Span


@dataclass(frozen=True)
class Once:
    """`once condition within 4.0 sec`."""

    condition: Expression
    duration: Expression
    span: Span


@dataclass(frozen=True)
class Response:
    """`after cause, answer within 4.0 sec`."""

    cause: Expression
    answer: Expression
    duration: Expression
    span: Span


@dataclass(frozen=True)
class SkillArgument:
    """`Object: skiros.Fragile` after the name of a skill; `kind` is the class as written."""

    parameter: Name
    kind: Name
    span: Span


@dataclass(frozen=True)
class Doing:
    """`doing Push(Object: Fragile)`: a skill runs, with an individual of a class. `ahead Push`: the
    skill can start next.
    """

    skill: Name
    arguments: tuple[SkillArgument, ...]
    is_ahead: bool
    span: Span


@dataclass(frozen=True)
class Parenthesized:
    """`(x)`, stored for the formatter."""

    inner: Expression
    span: Span


@dataclass(frozen=True)
class Broken:
    """Text that could not be parsed; its finding is already reported."""

    span: Span


Expression = (
    Number
    | Boolean
    | Text
    | Bracket
    | Reference
    | Member
    | Index
    | Sector
    | Call
    | Edges
    | Oscillates
    | ListFold
    | Unary
    | Binary
    | Membership
    | Held
    | Since
    | Once
    | Response
    | Doing
    | Parenthesized
    | Broken
)
