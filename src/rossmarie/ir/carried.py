"""The numbers that a field of a message can carry: fields of some types hold only whole numbers
within limits.
"""

from __future__ import annotations

import math

from rossmarie.ir.model import FLAG_LIMITS, Array, Slot

Limits = tuple[float, float]

_ROUNDING = 1e-12


def raw_of(source: Slot | Array, si: float) -> float:
    """S7 in reverse: the number in a message for the SI value `si`; for a field of whole numbers,
    the nearest whole number. A value in the unit of the message arrives exactly as the rules would
    read it.
    """
    is_plain = source.scale == 1.0 and source.offset == 0.0
    number = si if is_plain else (si - source.offset) / source.scale
    if source.limits is None or math.isnan(number):
        return number
    return float(round(min(max(number, source.limits[0]), source.limits[1])))


def si_ends(source: Slot | Array, ends: Limits) -> Limits:
    """The ends in SI of an interval of raw numbers (S7)."""
    one, other = (end * source.scale + source.offset for end in ends)
    return (one, other) if one <= other else (other, one)


def carries(source: Slot | Array, si: float) -> bool:
    """Say whether a field can carry a value in SI."""
    return source.limits is None or is_carried(source.limits, (si - source.offset) / source.scale)


def holds_flags(array: Array) -> bool:
    """Say whether the elements are propositions."""
    return array.limits == FLAG_LIMITS


def is_carried(limits: Limits, raw: float) -> bool:
    """Say whether a field with these limits can carry a number, up to rounding."""
    if not math.isfinite(raw):
        return False
    near = round(raw)
    is_near = math.isclose(raw, near, rel_tol=_ROUNDING, abs_tol=_ROUNDING)
    return is_near and limits[0] <= near <= limits[1]
