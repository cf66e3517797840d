"""The items of a file."""

from __future__ import annotations

from dataclasses import dataclass

from dslkit.source import SourceFile, Span
from rossmarie.syntax.ast.effects import Effect
from rossmarie.syntax.ast.expressions import Bracket, Doing, Expression, Name, Number, Text, Unit
from rossmarie.syntax.ast.imports import Import, Parameter
from rossmarie.syntax.ast.tests import Test


@dataclass(frozen=True)
class TopicDeclaration:
    """`topic Wrench = /ft/wrench : geometry_msgs/Wrench from tool at 100 Hz;` -- alias, unit, frame
    and rate are optional. `source` is the frame that the headers of its messages say.
    """

    alias: Name | None
    topic: Name
    message_type: Name
    unit: Unit | None
    rate: Expression | None
    span: Span
    source: Name | None = None


@dataclass(frozen=True)
class ServiceDeclaration:
    """`service /arm/lock : std_srvs/SetBool;`."""

    name: Name
    service_type: Name
    span: Span


@dataclass(frozen=True)
class ServerDeclaration:
    """`server /move_base : move_base_msgs/MoveBase;` -- an action server."""

    name: Name
    action_type: Name
    span: Span


@dataclass(frozen=True)
class NodeDeclaration:
    """`node planner { publishes /cmd_vel; subscribes /odom; }`."""

    name: Name
    publishes: tuple[Name, ...]
    subscribes: tuple[Name, ...]
    span: Span


@dataclass(frozen=True)
class ResourceDeclaration:
    """`resource drive : /cmd_vel, /move_base;` -- topics, services and so on that command one
    thing.
    """

    name: Name
    targets: tuple[Name, ...]
    span: Span


@dataclass(frozen=True)
class UnitDeclaration:
    """`unit my_msgs/Wheel.speed = rad/s;` -- the unit of a message field."""

    message_type: Name
    path: tuple[Name, ...]
    unit: Unit
    span: Span


@dataclass(frozen=True)
class FrameDeclaration:
    """`frame camera = "front/camera_link" in base_link at [0.3, 0, 0.5] m turned [0, 20, 180] deg;`
    -- `at` and `turned` where it stays there; else the frame comes with /tf (it has a timeout) or
    with /tf_static.
    """

    alias: Name | None
    frame: Name
    parent: Name
    at: Expression | None
    turned: Expression | None
    timeout: Expression | None
    span: Span


@dataclass(frozen=True)
class MessagesDeclaration:
    """`messages "msg";` -- a folder of .msg, .srv and .action files, relative to the declaring
    file.
    """

    path: Text
    span: Span


SystemMember = (
    TopicDeclaration
    | ServiceDeclaration
    | ServerDeclaration
    | NodeDeclaration
    | ResourceDeclaration
    | UnitDeclaration
    | MessagesDeclaration
    | FrameDeclaration
)


@dataclass(frozen=True)
class System:
    """`system husky { ... }` -- a system model: what topics there are, and of what type."""

    name: Name
    members: tuple[SystemMember, ...]
    documentation: str | None
    span: Span


@dataclass(frozen=True)
class LatchedUntilReset:
    """`latched until reset`: released by an operator, while the rule's condition is false."""

    span: Span


@dataclass(frozen=True)
class Action:
    """`action lowSpeed;`, `action stop { block /cmd_vel; } latched until reset`.

    `body` is the span of `{ ... }`, if there is one.
    """

    name: Name
    body: Span | None
    effects: tuple[Effect, ...]
    latch: LatchedUntilReset | None
    documentation: str | None
    span: Span


@dataclass(frozen=True)
class Skills:
    """`skills "skills.json" timeout 0.5 sec;` -- the path is relative to the file with the item."""

    path: Text
    timeout: Expression | None
    span: Span


@dataclass(frozen=True)
class Constant:
    """`const maxSpeed = 0.5 m/s`. One that stands for a `parameter` has its value, and nobody wrote
    it as a constant.
    """

    name: Name
    value: Expression
    documentation: str | None
    span: Span
    parameter: Parameter | None = None


@dataclass(frozen=True)
class ElementNames:
    """`names ["shoulder", "elbow"]`, in the order of the elements."""

    texts: tuple[Text, ...]
    span: Span


@dataclass(frozen=True)
class SkillNumber:
    """`Push.Object.Weight`: a number of a skill that runs; `steps` are the parameter, and a
    property of the thing that it is.
    """

    skill: Name
    steps: tuple[Name, ...]
    span: Span


@dataclass(frozen=True)
class Input:
    """`input pitch = topic /imu/data : sensor_msgs/Imu .orientation in rad timeout 0.2 sec`.

    In the printed form `topic Wrench.force` the topic is a plain name and `message_type` is None:
    a system model knows it. `bound` is the number behind `up to`. `number` is what stands behind
    `= doing` instead of a topic, which has no text then. `source` is the frame behind `from`,
    `frame` the one behind `in`; a bare name behind the only `in` is the `unit`, though it may be
    meant as a frame. A `setting` is the value of a parameter that the running node may set, which
    is no message of a topic.
    """

    name: Name
    topic: Name
    message_type: Name | None
    path: tuple[Name, ...]
    names: ElementNames | None
    unit: Unit | None
    timeout: Expression | None
    documentation: str | None
    span: Span
    bound: Number | None = None
    number: SkillNumber | None = None
    source: Name | None = None
    frame: Name | None = None
    setting: Constant | None = None


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
class Motion:
    """`motion drive { position : pose; ... }`: a motion of the robot, and how it brakes."""

    name: Name
    parts: tuple[Condition, ...]
    documentation: str | None
    span: Span


@dataclass(frozen=True)
class Shape:
    """`box [0.2, 0.9, -0.4, 0.4] m`, `circle [0.9, 0] m radius 0.4 m` or `polygon [0, 1], [1, 1],
    [1, 2] m`; `word` is the first one, `radius` that of a circle.
    """

    word: Name
    brackets: tuple[Bracket, ...]
    radius: Expression | None
    span: Span


@dataclass(frozen=True)
class Zone:
    """`zone stopZone in base_link { ... }`: some shapes in the x-y plane of a frame."""

    name: Name
    frame: Name
    shapes: tuple[Shape, ...]
    documentation: str | None
    span: Span


@dataclass(frozen=True)
class Keeps:
    """`keeps MOTION below SPEED in CLASS`."""

    motion: Name
    speed: Expression
    place: Name
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


ResumeContract = ClearWhen | ClearFor | LatchedUntilReset


@dataclass(frozen=True)
class Step:
    """`ACTION`, or `also ACTION else ACTION`: `also` puts it beside the step before it, `otherwise`
    is what follows if it fails.
    """

    is_beside: bool
    action: Name
    otherwise: Name | None
    span: Span


@dataclass(frozen=True)
class Feedback:
    """`1.0 per activation`, `0.5 per sec`; `time` is the unit behind `per`, None at the former."""

    amount: Expression
    time: Unit | None
    span: Span


@dataclass(frozen=True)
class Margin:
    """`margin in N`; without a unit it is a plain number."""

    unit: Unit | None
    span: Span


@dataclass(frozen=True)
class Exemption:
    """`unless doing SKILL then if COND then { STEP; ... }`: while the skill runs, the rule does not
    do what it does otherwise. `steps` is what it does instead, None if nothing; `condition` is
    what it looks at instead, None if that stays.
    """

    doing: Doing
    condition: Expression | None
    steps: tuple[Step, ...] | None
    span: Span


@dataclass(frozen=True)
class Rule:
    """`rule NAME: always if COND while doing SKILL unless RULE then { STEP; ... } EXEMPTION
    CONTRACT keeps MOTION below SPEED in CLASS category WORD task WORD feedback AMOUNT mitigates
    HAZARD` -- all but the condition and the steps is optional.

    More than one contract is reported by the checker. `always` is the place of that word. A rule
    that was `made_from` an exemption stands for it; nobody wrote it.
    """

    name: Name | None
    condition: Expression
    unless: tuple[Name, ...]
    steps: tuple[Step, ...]
    contracts: tuple[ResumeContract, ...]
    category: Name | None
    task: Name | None
    feedback: tuple[Feedback | Margin, ...]
    mitigates: tuple[Name, ...]
    documentation: str | None
    span: Span
    always: Span | None = None
    scope: tuple[Doing, ...] = ()
    exemptions: tuple[Exemption, ...] = ()
    made_from: Exemption | None = None
    keeps: Keeps | None = None

    @property
    def actions(self) -> tuple[Name, ...]:
        """The actions of the steps."""
        return tuple(step.action for step in self.steps)

    @property
    def head(self) -> Span:
        """The place that stands for the rule in messages: its name, or its condition."""
        return self.condition.span if self.name is None else self.name.span


@dataclass(frozen=True)
class Priority:
    """`priority stop_here over slow_down over go_home;` -- rules, the most important first."""

    rules: tuple[Name, ...]
    span: Span


@dataclass(frozen=True)
class Hazard:
    """`hazard H1 "collision with person";` -- what may happen, in words."""

    name: Name
    text: Text
    documentation: str | None
    span: Span


Item = (
    Import
    | System
    | Action
    | Skills
    | Parameter
    | Constant
    | Input
    | Entity
    | Motion
    | Zone
    | Rule
    | Priority
    | Hazard
    | Test
)


@dataclass(frozen=True)
class Module:
    """One parsed file. `is_whole` is False if it could not be read to its end: then nobody knows
    what it declares.
    """

    file: SourceFile
    items: tuple[Item, ...]
    is_whole: bool = True
