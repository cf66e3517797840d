"""Facts about fields of whole numbers, in SI, that z3 has to know.

Where a message is converted, the result is rounded, which formulas leave room for: with `is_wide`
enough for the greatest numbers of the field, so that what they exclude cannot be.
"""

from __future__ import annotations

import z3

from rossmarie import ir
from rossmarie.analysis.terms import constant

_LEAST_ROOM = 1e-10
_ROUNDING = 4e-16


def field_facts(
    source: ir.Slot | ir.Array, term: z3.ArithRef, name: str, *, is_wide: bool
) -> list[z3.BoolRef]:
    """That a field can carry a value; `name` is that of a new variable of the solver."""
    if source.limits is None:
        return []
    low, high = map(int, source.limits)
    whole = z3.Int(name)
    converted = z3.ToReal(whole) * constant(source.scale) + constant(source.offset)
    room = _room(source, is_wide=is_wide)
    return [whole >= low, whole <= high, term >= converted - room, term <= converted + room]


def ramp_facts(
    source: ir.Slot, now: z3.ArithRef, step: z3.ArithRef, count: int, name: str
) -> list[z3.BoolRef]:
    """That a field can carry `now`, a step less, and up to `count` steps more."""
    if source.limits is None:
        return []
    converted = z3.ToReal(z3.Int(name)) * constant(source.scale)
    room = _room(source, is_wide=False)
    facts = [step >= converted - room, step <= converted + room]
    ends = sorted(end * source.scale + source.offset for end in source.limits)
    for value in (now - step, now + count * step):
        facts += [value >= constant(ends[0]), value <= constant(ends[1])]
    return facts


def _room(source: ir.Slot | ir.Array, *, is_wide: bool) -> z3.ArithRef:
    if source.limits is None or (source.scale, source.offset) == (1.0, 0.0):
        return constant(0.0)
    most = max(map(abs, source.limits)) * abs(source.scale) + abs(source.offset)
    least = _LEAST_ROOM * abs(source.scale)
    return constant(max(least, _ROUNDING * most) if is_wide else least)
