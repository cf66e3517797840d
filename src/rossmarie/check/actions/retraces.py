"""Poses that a rule sends back: the remembered pose, the size of the memory, and the target."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from rossmarie.check.actions.assignments import assignments_of
from rossmarie.check.actions.numbers import period_ns
from rossmarie.check.actions.retrace_errors import (
    MessageWithoutPose,
    NotAPose,
    OddDistance,
    PoseCount,
    RetracedCommand,
)
from rossmarie.check.actions.targets import SentMessage, TargetResolver
from rossmarie.check.effects import CheckedRetrace
from rossmarie.check.expressions.frequencies import is_positive
from rossmarie.check.expressions.infer import infer
from rossmarie.check.names.fields import members
from rossmarie.check.operations.operands import duration_ns, require_constant
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import text_of
from rossmarie.check.units.quantities import SECOND
from rossmarie.check.wording.describe import describe
from rossmarie.ir import reactions
from rossmarie.ir.limits import MOST_POSES
from rossmarie.syntax import ast
from rossmarie.types import Message, Quantity, Type, Unknown, Vector, message_value
from rossmarie.units import parse_unit

POSE = "geometry_msgs/Pose"
_METRE = parse_unit("m")
_APART = (SECOND.dimension, _METRE.dimension)
_POSITION = tuple((axis,) for axis in "xyz")
_NUMBERS = tuple(("position", axis) for axis in "xyz") + tuple(
    ("orientation", axis) for axis in "xyzw"
)


def checked_retrace(
    effect: ast.Retrace, targets: TargetResolver, published: Collection[str]
) -> CheckedRetrace | None:
    """The checked effect; None after reporting an error. `published` are the topics on which nodes
    of the system model publish.
    """
    context = targets.context
    type_ = _pose(effect, context)
    sent = targets.topic(effect.target, "geometry_msgs/PoseStamped")
    assignments = assignments_of(effect.assignments, sent, targets)
    numbers = None if sent is None or type_ is None else _numbers(effect, sent, type_, context)
    apart = _apart(effect, context)
    most = _most(effect.most, context)
    period = period_ns(effect.rate, context)
    if sent is not None and (sent.name in published or sent.name in targets.commanded):
        context.collector.add(RetracedCommand(topic=sent.name).at(effect.target.span))
        return None
    if sent is None or assignments is None or numbers is None:
        return None
    if apart is None or most is None or period is None:
        return None
    place = sent.name, sent.type, assignments, numbers
    return CheckedRetrace(effect.pose, *place, period, most, *apart)


def _pose(effect: ast.Retrace, context: Context) -> Type | None:
    """The type of the pose: a position in m, or a pose."""
    type_ = infer(effect.pose, context)
    if isinstance(type_, Unknown):
        return None
    is_pose = isinstance(type_, Message) and type_.name == POSE
    is_read = _is_part_of_input(effect.pose, context)
    if is_read and (is_pose or _is_position(type_)):
        return type_
    found = describe(type_) if is_read else "computed"
    finding = NotAPose(identifier=text_of(effect.pose), found=found)
    context.collector.add(finding.at(effect.pose.span))
    return None


def _is_part_of_input(node: ast.Expression, context: Context) -> bool:
    while isinstance(node, ast.Member):
        node = node.value
    return isinstance(node, ast.Reference) and node.name.text in context.inputs


def _is_position(type_: Type) -> bool:
    if not isinstance(type_, Vector) or type_.element.unit is None:
        return False
    return type_.element.unit.dimension == _METRE.dimension


def _numbers(
    effect: ast.Retrace, sent: SentMessage, type_: Type, context: Context
) -> tuple[reactions.FieldPath, ...] | None:
    """The fields of the message that take the numbers of a pose."""
    is_pose = isinstance(type_, Message)
    found = list(_places(message_value(sent.message), is_pose))
    if len(found) == 1:
        return tuple((*found[0], *path) for path in (_NUMBERS if is_pose else _POSITION))
    words = "pose" if is_pose else "position in m"
    examples = "geometry_msgs/Pose or PoseStamped" if is_pose else "geometry_msgs/Point"
    finding = MessageWithoutPose(type=sent.type, pose=words, examples=examples)
    context.collector.add(finding.at(effect.target.span))
    return None


def _places(type_: Type, is_pose: bool) -> Iterator[tuple[str, ...]]:
    """The paths to a pose of this type in a message: the message itself, or one of its fields."""
    for path, each in (((), type_), *(((name,), field) for name, field in members(type_).items())):
        if is_pose and isinstance(each, Message) and each.name == POSE:
            yield path
        elif not is_pose and isinstance(each, Vector) and each.element.unit == _METRE:
            yield path
            return


def _apart(effect: ast.Retrace, context: Context) -> tuple[float, int] | None:
    """The least distance and the least time between two poses; 0 if not given."""
    distance, time_ns = 0.0, 0
    is_right = True
    for node in effect.apart:
        type_ = infer(node, context)
        unit = type_.unit if isinstance(type_, Quantity) else None
        if isinstance(type_, Unknown):
            is_right = False
        elif unit is not None and unit.dimension == SECOND.dimension and not time_ns:
            time_ns = duration_ns(node, "the value after `apart`", context) or 0
            is_right = is_right and time_ns > 0
        elif unit is not None and unit.dimension == _METRE.dimension and not distance:
            is_known = require_constant(node, "the value after `apart`", context)
            is_right = is_right and is_known and is_positive(node, "a distance", context)
            distance = context.values[node].numbers[0] if is_right else 0.0
        else:
            is_right = False
            is_twice = unit is not None and unit.dimension in _APART
            found = "said twice" if is_twice else describe(type_)
            context.collector.add(OddDistance(found=f"this is {found}").at(node.span))
    return (distance, time_ns) if is_right else None


def _most(number: ast.Number, context: Context) -> int | None:
    is_plain = number.unit is None and number.value == int(number.value)
    if is_plain and 1 <= number.value <= MOST_POSES:
        return int(number.value)
    finding = PoseCount(most=MOST_POSES, found=number.span.text)
    context.collector.add(finding.at(number.span))
    return None
