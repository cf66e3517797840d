"""The items of a file."""

from __future__ import annotations

from dataclasses import dataclass

from dslkit.source import SourceFile, Span
from rossmarie.syntax.ast.effects import Effect
from rossmarie.syntax.ast.expressions import Doing, Expression, Name, Number, Text, Unit
from rossmarie.syntax.ast.imports import Import, Parameter
from rossmarie.syntax.ast.tests import Test
from rossmarie.syntax.ast.zones import Zone


@dataclass(frozen=True)
class TopicDeclaration:
    """`topic Wrench = /ft/wrench : geometry_msgs/Wrench from tool at 100 Hz;` -- alias, unit, frame
    and rate are optional. `source` is the frame in the headers of its messages.
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
    """`resource drive : /cmd_vel, /move_base;` -- topics, services and so on that command the same
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
    -- `at` and `turned` are for a fixed frame; other frames arrive on /tf (with a timeout) or on
    /tf_static.
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
    """`system husky { ... }` -- a system model: the topics of a robot with their types."""

    name: Name
    members: tuple[SystemMember, ...]
    documentation: str | None
    span: Span


@dataclass(frozen=True)
class LatchedUntilReset:
    """`latched until reset`: an operator releases the rule while its condition is false."""

    span: Span


@dataclass(frozen=True)
class Action:
    """`action lowSpeed;`, `action stop { block /cmd_vel; } latched until reset`.

    `body` is the span of `{ ... }`, if it exists.
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
    """`const maxSpeed = 0.5 m/s`. A constant for a `parameter` has the value of the parameter, and
    does not occur in the text.
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
    """`Push.Object.Weight`: a number of a running skill. `steps` are the parameter, and a property
    of its individual.
    """

    skill: Name
    steps: tuple[Name, ...]
    span: Span


@dataclass(frozen=True)
class Input:
    """`input pitch = topic /imu/data : sensor_msgs/Imu .orientation in rad timeout 0.2 sec`.

    In the short form `topic Wrench.force`, the topic is a plain name and `message_type` is None,
    because a system model declares it. `bound` is the number after `up to`. `number` is the number
    after `= doing`; then the topic has no text. `source` is the frame after `from`, `frame` the
    frame after `in`. A bare name after the only `in` is the `unit`, although it may be meant as a
    frame. A `setting` is the value of a parameter that the running node may set; it is not a
    message of a topic.
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
    """`motion drive { position : pose; ... }`: a motion of the robot, and its braking."""

    name: Name
    parts: tuple[Condition, ...]
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
    """`clear when COND`: the rule is released when its condition is false and COND is true."""

    condition: Expression
    span: Span


@dataclass(frozen=True)
class ClearFor:
    """`clear for 2.0 sec`: the rule is released when its condition has been false for this time."""

    duration: Expression
    span: Span


ResumeContract = ClearWhen | ClearFor | LatchedUntilReset


@dataclass(frozen=True)
class Step:
    """`ACTION`, or `also ACTION else ACTION`. `also` starts the step together with the step before
    it. `otherwise` is the action after a failure.
    """

    is_beside: bool
    action: Name
    otherwise: Name | None
    span: Span


@dataclass(frozen=True)
class Feedback:
    """`1.0 per activation`, `0.5 per sec`. `time` is the unit after `per`, None for the first
    form.
    """

    amount: Expression
    time: Unit | None
    span: Span


@dataclass(frozen=True)
class Margin:
    """`margin in N`. Without a unit, the margin is a plain number."""

    unit: Unit | None
    span: Span


@dataclass(frozen=True)
class Exemption:
    """`unless doing SKILL then if COND then { STEP; ... }`: while the skill runs, the rule is not
    applied. `steps` replace the steps of the rule, None if there are none. `condition` replaces its
    condition, None if the condition stays.
    """

    doing: Doing
    condition: Expression | None
    steps: tuple[Step, ...] | None
    span: Span


@dataclass(frozen=True)
class Rule:
    """`rule NAME: always if COND while doing SKILL unless RULE then { STEP; ... } EXEMPTION
    CONTRACT keeps MOTION below SPEED in CLASS category WORD task WORD feedback AMOUNT mitigates
    HAZARD` -- all parts except the condition and the steps are optional.

    The checker reports more than one contract. `always` is the place of this word. A rule that was
    `made_from` an exemption stands for the exemption and has no text of its own.
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
        """The place of the rule for messages: its name, or else its condition."""
        return self.condition.span if self.name is None else self.name.span


@dataclass(frozen=True)
class Priority:
    """`priority stop_here over slow_down over go_home;` -- rules, the most important first."""

    rules: tuple[Name, ...]
    span: Span


@dataclass(frozen=True)
class Hazard:
    """`hazard H1 "collision with person";` -- a possible harm, in words."""

    name: Name
    text: Text
    documentation: str | None
    span: Span


Item = (
    Import | System | Action | Skills | Parameter | Constant | Input | Entity | Motion | Zone
    | Rule | Priority | Hazard | Test
)  # fmt: skip


@dataclass(frozen=True)
class Module:
    """One parsed file. `is_whole` is False if the parser could not read it to its end, so that some
    declarations are unknown.
    """

    file: SourceFile
    items: tuple[Item, ...]
    is_whole: bool = True
