"""Motions: position, speed and brakes."""

from __future__ import annotations

from collections.abc import Mapping

from dslkit.diagnostics import listed
from rossmarie.check.expressions.infer import infer
from rossmarie.check.foresight.errors import (
    IncompleteMotion,
    UnknownMotionPart,
    UnlimitedReaction,
)
from rossmarie.check.frames import CheckedFrame
from rossmarie.check.model import CheckedInput, CheckedMotion
from rossmarie.check.names.regions import check_frame
from rossmarie.check.operations.function_errors import UnfitMotionPart
from rossmarie.check.operations.operands import scalar_operand
from rossmarie.check.operations.stopping import constant
from rossmarie.check.scopes.context import Context, ItemUses
from rossmarie.check.scopes.declarations import report_second
from rossmarie.check.wording.describe import describe
from rossmarie.syntax import ast
from rossmarie.types import Quantity, Unknown, faults_of_position, unit_faults
from rossmarie.units import parse_unit

_FORMS: Mapping[str, str] = {
    "position": "`position : pose;`",
    "speed": "`speed : velocity.x;`",
    "brake": "`brake : 0.6 m/s^2;`",
    "acceleration": "`acceleration : 0.5 m/s^2;`",
    "fastest": "`fastest : 1.5 m/s;`",
    "latency": "`latency : 0.2 sec;`",
}
"""The parts of a motion, with an example for each."""

_UNITS: Mapping[str, str] = {
    "speed": "m/s",
    "brake": "m/s^2",
    "acceleration": "m/s^2",
    "fastest": "m/s",
    "latency": "s",
}
_MAY_BE_ZERO = frozenset({"acceleration", "latency"})
_NS = 1e-9


def check_motions(context: Context) -> None:
    """Check every motion of the program, and record the correct ones in `context.motions`."""
    for item in context.declarations.items:
        if isinstance(item, ast.Motion):
            found = _checked(item, context)
            if found is not None:
                context.motions.setdefault(item.name.text, found)


def _checked(motion: ast.Motion, context: Context) -> CheckedMotion | None:
    uses = context.enter(None)
    parts = _parts(motion, context)
    is_right = len(parts) == len(motion.parts) and _is_whole(motion, parts, context)
    numbers: dict[str, float] = {}
    for name, part in parts.items():
        infer(part.expression, context)
        number = _part(name, part.expression, context)
        is_right = is_right and number is not None
        numbers[name] = number or 0.0
    if not is_right or not _is_limited(motion, uses, context):
        return None
    used = [context.inputs[name] for name in sorted(uses.inputs)]
    moving = [each for one in used for each in _moving_frames(one, context)]
    timeouts = [*(each.timeout_ns for each in used), *(each.timeout_ns for each in moving)]
    longest_ns = max((each or 0 for each in timeouts), default=0)
    return CheckedMotion(
        declaration=motion,
        position=parts["position"].expression,
        speed=parts["speed"].expression,
        brake=numbers["brake"],
        acceleration=numbers["acceleration"],
        fastest=numbers["fastest"],
        latency_s=numbers["latency"],
        timeout_s=longest_ns * _NS,
        is_of_one_message=len({each.topic for each in used}) == 1 and not moving,
        inputs=tuple(sorted(uses.inputs)),
    )


def _moving_frames(used: CheckedInput, context: Context) -> list[CheckedFrame]:
    """The moving frames on the path of an input. Each may have moved by any amount until its
    timeout.
    """
    if used.source is None or used.target is None:
        return []
    legs = context.frames.path(used.source, used.target) or ()
    return [leg.frame for leg in legs if leg.frame.timeout_ns is not None]


def _parts(motion: ast.Motion, context: Context) -> dict[str, ast.Condition]:
    """The parts by name, after reporting unknown and repeated parts."""
    found: dict[str, ast.Condition] = {}
    for part in motion.parts:
        if part.name.text not in _FORMS:
            finding = UnknownMotionPart(identifier=part.name.text, known=listed(tuple(_FORMS)))
            context.report_unknown(finding, part.name, _FORMS)
            continue
        first = found.setdefault(part.name.text, part)
        if first is not part:
            reason = "a motion has each part once"
            report_second(part.name, first.name, "part", reason, context.collector)
    return found


def _is_whole(motion: ast.Motion, parts: Mapping[str, ast.Condition], context: Context) -> bool:
    missing = [name for name in _FORMS if name not in parts]
    if missing:
        finding = IncompleteMotion(
            motion=motion.name.text,
            missing=listed(missing),
            form=", ".join(_FORMS[name] for name in missing),
        )
        context.collector.add(finding.at(motion.name.span))
    return not missing


def _part(name: str, node: ast.Expression, context: Context) -> float | None:
    """The number of a part, or 0 if the part is not constant. None, after reporting, if the part is
    wrong.
    """
    type_ = context.type_of(node)
    if isinstance(type_, Unknown):
        return None
    if name == "position":
        return _position(node, context)
    if not _has_unit(name, node, context):
        return None
    return 0.0 if name == "speed" else constant(f"`{name}`", node, name in _MAY_BE_ZERO, context)


def _has_unit(name: str, node: ast.Expression, context: Context) -> bool:
    operand = scalar_operand(node, context)
    unit = _UNITS[name]
    if operand is None or not unit_faults(operand.quantity, Quantity(parse_unit(unit))):
        return operand is not None
    finding = UnfitMotionPart(
        part=f"`{name}`", expected=f"a number in {unit}", found=describe(operand.quantity)
    )
    context.collector.add(finding.at(node.span))
    return False


def _position(node: ast.Expression, context: Context) -> float | None:
    type_ = context.type_of(node)
    if faults_of_position(type_):
        finding = UnfitMotionPart(
            part="`position`", expected="a position in m, or a pose", found=describe(type_)
        )
        context.collector.add(finding.at(node.span))
        return None
    return 0.0 if check_frame(node, context) else None


def _is_limited(motion: ast.Motion, uses: ItemUses, context: Context) -> bool:
    """Say whether all inputs of a motion have a timeout. Report the inputs without one."""
    unlimited = [name for name in sorted(uses.inputs) if context.inputs[name].timeout_ns is None]
    for name in unlimited:
        finding = UnlimitedReaction(motion=motion.name.text, input=name)
        context.collector.add(finding.at(context.inputs[name].declaration.name.span))
    return not unlimited
