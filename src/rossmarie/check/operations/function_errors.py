"""Mistakes in calls of functions, and in `oscillates`."""

from __future__ import annotations

from dslkit.diagnostics import Error, Remark, Template


class UnknownFunction(Error, code="ROSS107", name="unknown-function"):
    """A call of a function that does not exist."""

    title = "there is no function `{identifier}`"
    label = "not a built-in function"
    identifier: str

    class Known(Remark):
        says = "the functions are {known}"
        known: str


class WrongArgumentCount(Error, code="ROSS209", name="wrong-argument-count"):
    """A call with too few or too many arguments."""

    title = "`{function}` takes {expected}"
    label = "{found} given"
    help = "write `{usage}`"
    function: str
    expected: str
    found: str
    usage: str


class WrongArgument(Error, code="ROSS210", name="wrong-argument"):
    """A call of a function on a value of the wrong type."""

    title = "`{function}` needs {expected}"
    label = "this is {found}"
    help = "write `{usage}`"
    function: str
    expected: str
    found: str
    usage: str

    class OfFields(Remark):
        says = "write {calls}"
        calls: str


class ElementwiseMixture(Error, code="ROSS211", name="elementwise-mixture"):
    """An elementwise expression over more than one array, constants and numbers of messages."""

    title = "an elementwise expression may use one array, constants and numbers of messages"
    label = "{found}"
    note = "`{function}` looks at the elements of one array, one by one"
    help = "compare the least or greatest element with `{text}`: `min(...)` or `max(...)`"
    found: str
    function: str
    text: str

    class Array(Remark):
        says = "the array"

    class OneProposition(Remark):
        says = "`{text}` is one boolean for all elements: move it out of `{function}`"
        text: str
        function: str

    class TakenOut(Remark):
        says = "`{text}` is one boolean for all elements: move it out of `{function}`, `{meant}`"
        text: str
        function: str
        meant: str


class AgeMisused(Error, code="ROSS219", name="age-misused"):
    """`age` anywhere but on one side of a comparison with a constant time."""

    title = "`age` can only be compared with a constant time"
    label = "{reason}"
    note = "an age grows by itself; the monitor has to know the instant at which it matters"
    help = "write `age(INPUT) > 0.5 sec`; with `<`, `<=`, `>` or `>=`"
    reason: str


class OscillationCount(Error, code="ROSS220", name="oscillation-count"):
    """A number of turning points that is too small or too large to count."""

    title = "the number of turning points must be a whole number from 1 to {most}"
    label = "this is {found}"
    help = "write `3 times`"
    found: str
    most: int


class EdgesMisused(Error, code="ROSS234", name="edges-misused"):
    """A count of edges anywhere but on one side of a comparison with a constant."""

    title = "a count of edges within a time can only be compared with a constant whole number"
    label = "{reason}"
    note = "a monitor keeps only as many edges as the comparison needs, so the number must be known"
    help = "write `count(edges of CONDITION within 10 sec) > 3`"
    reason: str


class EdgeCount(Error, code="ROSS235", name="edge-count"):
    """A limit for a count of edges that is too large, or that every count exceeds."""

    title = "a count of edges must be compared with a whole number from 0 to {most}"
    label = "{reason}"
    help = "write `count(edges of CONDITION within 10 sec) > 3`"
    reason: str
    most: int


class ChangedMisused(Error, code="ROSS236", name="changed-misused"):
    """`changed` applied to a value that is not a number, vector or flag of a message."""

    title = "`changed` needs a number, a vector or a flag of a message"
    label = "this is {found}"
    found: str

    class Texts(Remark):
        says = (
            "all strings that the rules do not mention are equal to a monitor: it would miss most "
            "changes"
        )

    class Compared(Remark):
        says = 'compare it with the string that matters: `{text} == "..."`'
        text: str

    class Edges(Remark):
        says = "a condition has edges: write `count(edges of {text} within 1 sec) > 0`"
        text: str


class UnfitMotionPart(Error, code="ROSS265", name="unfit-motion-part"):
    """A part of a motion, or a speed limit, of the wrong type or size."""

    title = "{part} must be {expected}"
    label = "this is {found}"
    part: str
    expected: str
    found: str


class UnfitAmount(Error, code="ROSS283", name="unfit-amount"):
    """An argument of `braking_distance` or `time_to` of the wrong type or size."""

    title = "{part} of `{function}` must be {expected}"
    label = "this is {found}"
    help = "write `{usage}`"
    function: str
    part: str
    expected: str
    found: str
    usage: str


ALL: tuple[type[Template], ...] = (
    UnknownFunction,
    WrongArgumentCount,
    WrongArgument,
    ElementwiseMixture,
    AgeMisused,
    OscillationCount,
    EdgesMisused,
    EdgeCount,
    ChangedMisused,
    UnfitMotionPart,
    UnfitAmount,
)
