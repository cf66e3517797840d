"""The stopping distance of a motion, as signals: `stopping(drive, 0.3 m/s)`."""

from __future__ import annotations

from rossmarie import ir
from rossmarie.check.model import CheckedMotion
from rossmarie.lowering.nodes import Nodes, Shown
from rossmarie.units import Unit, parse_unit

_SPEED, _BRAKE, _TIME = parse_unit("m/s"), parse_unit("m/s^2"), parse_unit("s")
_SQUARE = parse_unit("m^2/s^2")


def stopping_distance(
    measured: int, motion: CheckedMotion, wanted: float, shown: Shown, nodes: Nodes
) -> int:
    """The greatest distance in m from the position in the last message to the place where the
    motion has slowed down (S65). `measured` is the signal of its speed, `wanted` the target speed
    in m/s.
    """
    span, name = shown.span, motion.declaration.name.text

    def number(value: float, unit: Unit) -> int:
        return nodes.constant(value, Shown(f"{value:g} {unit.symbol}", span, unit))

    def speed(function: ir.Function, *operands: int) -> int:
        text = f"speed of {name} when its brakes hold"
        return nodes.apply(function, operands, Shown(text, span, _SPEED))

    def speeds(function: ir.Function, *operands: int) -> int:
        return nodes.apply(function, operands, Shown(f"squares of speeds of {name}", span, _SQUARE))

    def metres(text: str, function: ir.Function, *operands: int) -> int:
        return nodes.apply(function, operands, Shown(f"{text} of {name}", span, shown.unit))

    gained = number(motion.acceleration * motion.reaction_s, _SPEED)
    fastest = number(motion.fastest, _SPEED)
    most = speed(ir.Function.ADD, speed(ir.Function.ABSOLUTE, measured), gained)
    reached = speed(ir.Function.MINIMUM, most, fastest)
    # A separate speed message may be older or newer than the position, so the motion may be faster.
    travelling = reached if motion.is_of_one_message else fastest
    reaction = number(motion.reaction_s, _TIME)
    until_brakes = metres("distance until the brakes", ir.Function.MULTIPLY, travelling, reaction)
    square = speeds(ir.Function.MULTIPLY, reached, reached)
    lost = speeds(ir.Function.SUBTRACT, square, number(wanted * wanted, _SQUARE))
    twice = number(2.0 * motion.brake, _BRAKE)
    braking = metres("braking distance", ir.Function.DIVIDE, lost, twice)
    whole = metres("whole distance", ir.Function.ADD, until_brakes, braking)
    return nodes.apply(ir.Function.ABOVE, (reached, number(wanted, _SPEED), whole), shown)
