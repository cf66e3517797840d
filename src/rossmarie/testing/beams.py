"""Points of scans in tests: beams at whole degrees with given readings.

To find the angle of a point, a solver would have to compute sines and cosines. Therefore the points
of a proposal are neighbours, ahead of the scanner, to its left, behind it, or to its right. The
solver chooses the side and the distances.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import z3

from rossmarie import ir
from rossmarie.analysis.terms import constant
from rossmarie.core import Function
from rossmarie.ir.beams import USUAL_DISTANCES, scan_path
from rossmarie.ir.script import FieldValue

SIDES = (0, 90, -180, -90)
"""The possible angles of the first point, in degrees."""
_NOTHING = USUAL_DISTANCES[1] + 1.0
_WAVES = {Function.COSINE: math.cos, Function.SINE: math.sin}


def is_column(array: ir.Array, field: str) -> bool:
    """Say whether an array is a field of the points of a scan."""
    return tuple(array.path[-3:]) == (ir.RETURNS, ir.EACH, field)


def sides(side: z3.ArithRef) -> z3.BoolRef:
    """A formula: the term is the number of a side."""
    return z3.Or([side == number for number in range(len(SIDES))])


def angle(side: z3.ArithRef, part: int) -> z3.ArithRef:
    """The angle in rad of a point."""
    return _by_side(side, [constant(math.radians(each + part)) for each in SIDES])


def coordinate(
    machine: ir.Machine, share: int, distance: z3.ArithRef, side: z3.ArithRef, part: int
) -> z3.ArithRef:
    """The coordinate of a point: its distance times its share along an axis. The signal `share` is
    the sine or cosine of the point's angle.
    """
    wave = _wave_of(machine, share)
    assert wave is not None, "it is one"
    shares = (_WAVES[wave](math.radians(each + part)) for each in SIDES)
    return _by_side(side, [distance * constant(each) for each in shares])


def list_of_share(machine: ir.Machine, signal: int) -> int | None:
    """The scan's list, if a signal is the sine or cosine of its points' angle; else None."""
    node = machine.signals[signal].node
    if _wave_of(machine, signal) is None or not isinstance(node, ir.Apply):
        return None
    element = machine.signals[node.operands[0]].node
    return machine.arrays[element.array].list if isinstance(element, ir.Element) else None


def _wave_of(machine: ir.Machine, signal: int) -> Function | None:
    node = machine.signals[signal].node
    if not isinstance(node, ir.Apply) or node.function not in (Function.COSINE, Function.SINE):
        return None
    element = machine.signals[node.operands[0]].node
    is_angle = isinstance(element, ir.Element) and is_column(machine.arrays[element.array], "angle")
    return Function(node.function) if is_angle else None


def _by_side(side: z3.ArithRef, terms: Sequence[z3.ArithRef]) -> z3.ArithRef:
    found = terms[-1]
    for number, term in enumerate(terms[:-1]):
        found = z3.If(side == number, term, found)
    return found


def readings(
    machine: ir.Machine, array: ir.Array, distances: Sequence[float], side: float
) -> Iterator[FieldValue]:
    """The settings that give a scan points at exactly these distances in m."""
    path = scan_path(array.path)
    assert path is not None, "it is of a scan"
    used = machine.inputs[array.input]
    topic = machine.channels[used.channel].topic
    all_around = ir.Sector(-math.pi, 2.0 * math.pi)
    pairs = [(all_around, _NOTHING)]
    for part, distance in enumerate(distances):
        degree = SIDES[int(side)] + part
        pairs.append((ir.Sector(math.radians(degree - 0.5), math.radians(1.0)), distance))
    for sector, value in pairs:
        yield FieldValue(used.name, topic, (*path, "ranges", sector), value, None, "m")
