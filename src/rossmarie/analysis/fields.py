"""The values that fields of messages can have in SI, as facts about terms of the solver (S7).

There are three sets of facts for three kinds of query. A trace computes with exact numbers. A state
has to cover all values that doubles can give, including the rounded ends of a conversion. A test
has to be confirmed with doubles, so the values that it sets leave room for rounding.
"""

from __future__ import annotations

import z3

from rossmarie import ir
from rossmarie.analysis.terms import constant, within
from rossmarie.ir.beams import USUAL_DISTANCES
from rossmarie.ir.carried import si_ends

_LEAST_ROOM = 1e-10
_ROUNDING = 4e-16


def slot_facts(
    machine: ir.Machine, slot: ir.Slot, value: z3.ArithRef, *, rounded: bool
) -> list[z3.BoolRef]:
    """Facts about the values that a slot can have."""
    return kind_facts(machine, slot, value) + limit_facts(slot, value, rounded=rounded)


def kind_facts(
    machine: ir.Machine, source: ir.Slot | ir.Array, value: z3.ArithRef
) -> list[z3.BoolRef]:
    """Facts about the numbers that encode flags and texts."""
    match source.kind:
        case ir.FieldKind.FLAG:
            return [z3.Or(value == 0, value == 1)]
        case ir.FieldKind.TEXT:
            return [z3.Or([value == number for number in range(-1, len(machine.texts))])]
        case ir.FieldKind.REAL:
            return []


def limit_facts(
    source: ir.Slot | ir.Array, value: z3.ArithRef, *, rounded: bool
) -> list[z3.BoolRef]:
    """Facts about the values of a field of whole numbers; with `rounded`, as doubles."""
    if source.limits is None:
        return []
    if rounded and not _is_plain(source):  # the conversion is monotone, also after rounding
        return within(value, si_ends(source, source.limits))
    whole = z3.FreshInt("whole")
    converted = _converted(source, whole)
    return [*_is_held(source.limits, whole), value == converted]


def field_facts(
    source: ir.Slot | ir.Array, value: z3.ArithRef, name: str, *, is_wide: bool
) -> list[z3.BoolRef]:
    """Facts about the values that a field of whole numbers can carry, with room for rounding.

    `name` names a new variable of the solver. With `is_wide`, the facts also apply to the greatest
    numbers of the field, so excluded values are impossible. Without it, readings of a sector and
    distances of points are limited to values that the scans of tests measure.
    """
    is_of_points = tuple(source.path[-3:]) == (ir.RETURNS, ir.EACH, "range")
    is_of_sector = bool(source.path) and isinstance(source.path[-1], ir.Sector)
    if (is_of_sector or is_of_points) and not is_wide:
        return within(value, USUAL_DISTANCES)
    if source.limits is None:
        return []
    whole = z3.Int(name)
    converted, room = _converted(source, whole), _room(source, is_wide=is_wide)
    return [*_is_held(source.limits, whole), *_is_near(value, converted, room)]


def ramp_facts(
    source: ir.Slot, now: z3.ArithRef, step: z3.ArithRef, count: int, name: str
) -> list[z3.BoolRef]:
    """Facts: a field can carry `now`, one step less, and up to `count` steps more."""
    if source.limits is None:
        return []
    converted = z3.ToReal(z3.Int(name)) * constant(source.scale)
    ends = si_ends(source, source.limits)
    return [
        *_is_near(step, converted, _room(source, is_wide=False)),
        *within(now - step, ends),
        *within(now + count * step, ends),
    ]


def _is_plain(source: ir.Slot | ir.Array) -> bool:
    return (source.scale, source.offset) == (1.0, 0.0)


def _is_held(limits: tuple[float, float], whole: z3.ArithRef) -> list[z3.BoolRef]:
    low, high = map(int, limits)
    return [whole >= low, whole <= high]


def _converted(source: ir.Slot | ir.Array, whole: z3.ArithRef) -> z3.ArithRef:
    return z3.ToReal(whole) * constant(source.scale) + constant(source.offset)


def _is_near(value: z3.ArithRef, exact: z3.ArithRef, room: z3.ArithRef) -> list[z3.BoolRef]:
    return [value >= exact - room, value <= exact + room]


def _room(source: ir.Slot | ir.Array, *, is_wide: bool) -> z3.ArithRef:
    if source.limits is None or _is_plain(source):
        return constant(0.0)
    most = max(map(abs, source.limits)) * abs(source.scale) + abs(source.offset)
    least = _LEAST_ROOM * abs(source.scale)
    return constant(max(least, _ROUNDING * most) if is_wide else least)
