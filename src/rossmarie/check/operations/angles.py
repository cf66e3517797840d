"""Angles that jump by 360 deg at half a turn, in operations that need a continuous value."""

from __future__ import annotations

from dslkit.diagnostics import Remark
from rossmarie.check.operations.errors import JumpingAngle
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import stripped
from rossmarie.syntax import ast

_AXES = {"roll": "x", "yaw": "z"}
"""The angles that go from -180 to 180 deg, and the component of a rotation about the same axis."""


def warn_of_rate(call: ast.Call, context: Context) -> None:
    """Warn of a rate of change of such an angle."""
    angle = _angle(call.arguments[0])
    if angle is not None:
        _warn(call, angle, "its rate of change is enormous", context)


def warn_of_filter(call: ast.Call, context: Context) -> None:
    """Warn of a smoothed angle of this kind: the mean of 180 deg and -180 deg is the opposite
    direction.
    """
    angle = _angle(call.arguments[0])
    if angle is not None:
        effect = "the filtered value is near 0 deg, the opposite direction"
        help = JumpingAngle.Unfiltered(angle=angle)
        _warn(call, angle, effect, context, help)


def warn_of_difference(node: ast.Binary, context: Context) -> None:
    """Warn of a difference of two such angles."""
    left, right = _angle(node.left), _angle(node.right)
    if left is not None and right is not None:
        _warn(node, left, "the difference is close to 360 deg", context)


def _angle(node: ast.Expression) -> str | None:
    """`yaw` for `q.yaw()` and `previous(q.yaw())`."""
    inner = stripped(node)
    while isinstance(inner, ast.Call) and inner.function.text == "previous" and inner.arguments:
        inner = stripped(inner.arguments[0])
    is_angle = isinstance(inner, ast.Call) and inner.function.text in _AXES
    return inner.function.text if is_angle and isinstance(inner, ast.Call) else None


def _warn(
    node: ast.Expression, angle: str, effect: str, context: Context, help: Remark | None = None
) -> None:
    finding = JumpingAngle(angle=angle, effect=effect, axis=_AXES[angle])
    context.collector.add(finding.at(node.span, help=help))
