"""The way on which a motion slows down, as signals: `stopping(drive, 0.3 m/s)`."""

from __future__ import annotations

from rossmarie import ir
from rossmarie.check.model import CheckedMotion
from rossmarie.lowering.nodes import Nodes, Shown
from rossmarie.units import Unit, parse_unit

_SPEED, _BRAKE, _TIME = parse_unit("m/s"), parse_unit("m/s^2"), parse_unit("s")


def way_to_stop(
    measured: int, motion: CheckedMotion, wanted: float, shown: Shown, nodes: Nodes
) -> int:
    """The way in m from where the last message saw a motion to where it has slowed down, at the
    latest (S65). `measured` is the signal of its speed, `wanted` the one to slow down to, in m/s.
    """
    span, name = shown.span, motion.declaration.name.text

    def number(value: float, unit: Unit) -> int:
        return nodes.constant(value, Shown(f"{value:g} {unit.symbol}", span, unit))

    def speed(function: ir.Function, *operands: int) -> int:
        text = f"speed of {name} when its brakes hold"
        return nodes.apply(function, operands, Shown(text, span, _SPEED))

    gained = number(motion.acceleration * motion.reaction_s, _SPEED)
    fastest = number(motion.fastest, _SPEED)
    most = speed(ir.Function.ADD, speed(ir.Function.ABSOLUTE, measured), gained)
    reached = speed(ir.Function.MINIMUM, most, fastest)
    # A message of its own may have come when the motion was faster than another one says.
    travelling = reached if motion.is_of_one_message else fastest
    way = nodes.apply(
        ir.Function.MULTIPLY,
        (travelling, number(motion.reaction_s, _TIME)),
        Shown(f"way of {name} until its brakes hold", span, shown.unit),
    )
    slow, brake = number(wanted, _SPEED), number(motion.brake, _BRAKE)
    return nodes.apply(ir.Function.STOPPING, (reached, slow, brake, way), shown)
