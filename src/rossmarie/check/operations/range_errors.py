"""Mistakes in intervals and boxes, and in `in`."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class ScalarAsRange(Error, code="ROSS203", name="scalar-as-range"):
    """`in` followed by one number."""

    title = "`in` needs a range, not one number"
    label = "this is {found}"
    note = "one number has no inside; a range has two ends, `[low, high]`"
    found: str

    class NotConstant(Remark):
        says = "write two constant ends, `[low, high]`, or compare with `<` and `>`"

    class AroundZero(Remark):
        says = "if {end} to either side of zero is meant, write `{meant}`"
        end: str
        meant: str

    class Constant(Remark):
        says = "`{constant}` is one number"
        constant: str


class BracketLength(Error, code="ROSS212", name="bracket-length"):
    """A bracket that is neither an interval nor a box."""

    title = "a bracket holds 2 numbers (an interval) or 6 (a box), not {count}"
    label = "{count} here"
    help = "write `[low, high]`, or `[xmin, xmax, ymin, ymax, zmin, zmax]`"
    count: int


class RangeMismatch(Error, code="ROSS213", name="range-mismatch"):
    """`in` with a value that the range cannot contain."""

    title = "{value} cannot be in {container}"
    label = "this is {container}"
    note = "an interval holds numbers, a box vectors, and the places of a class positions in m"
    value: str
    container: str

    class Value(Remark):
        says = "this is {value}"
        value: str

    class OfPoints(Remark):
        says = "a point contains nothing; write `distance({value}, {container}) < 1 m`"
        value: str
        container: str

    class Position(Remark):
        says = "write a position before `in`, or an interval, `[low, high]`, after it"

    class Range(Remark):
        says = "write an interval, `in [low, high]`, or a box, after `in`"


class IntervalEndsSwapped(Error, code="ROSS216", name="interval-ends-swapped"):
    """An interval whose low end is above its high end."""

    title = "the ends of this interval are swapped"
    label = "no number is in here"
    note = "the low end comes first; {low} is more than {high}"
    help = "write `{corrected}`"
    low: str
    high: str
    corrected: str


class StringsAsRange(Error, code="ROSS224", name="strings-as-range"):
    """Texts in brackets, written as if `in` searched a list."""

    title = "brackets hold a range of numbers, not a list of strings"
    label = "these are strings"
    note = "strings have no order, so no string is between two other strings"
    help = "compare with each string, `==` or `!=`, and join by `or` or `and`"


ALL: tuple[type[Template], ...] = (
    ScalarAsRange,
    BracketLength,
    RangeMismatch,
    IntervalEndsSwapped,
    StringsAsRange,
)
