"""The rules of the monitor in `monitor.c`: the tables there by name, and three-valued logic.

S1... are the rules of docs/explanation/semantics.md.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

FALSE, TRUE, UNKNOWN, STALE = range(4)
NEVER_RECEIVED, FRESH, EXPIRED = range(3)
CLEARED, ACTIVATED, ACTIVATED_STALE, TIME_JUMP = range(4)
EARLIEST, LATEST, LONGEST = -(2**61), 2**62, 2**61
NAN = math.nan
MOST_SAMPLES = 4

INPUTS = {"x": (0, 500), "y": (1, None), "z": (0, 900)}
"""The channel and the timeout of each."""
VALUES = ["x", "y", "z", "least", "rate", "change", "median", "mean", "low_pass", "quotient", "sum"]
LEAVES = {
    "x_inside": "x",
    "x_outside": "x",
    "x_above": "x",
    "y_above": "y",
    "y_huge": "y",
    "z_above": "z",
    "least_above": "least",
    "least_huge": "least",
    "rate_above": "rate",
    "changed": "change",
    "median_above": "median",
    "mean_above": "mean",
    "low_pass_above": "low_pass",
    "quotient_above": "quotient",
    "sum_above": "sum",
}
"""The number that each looks at."""
RESTS_ON = {
    "x": ["x"],
    "y": ["y"],
    "z": ["z"],
    "least": ["least"],
    "rate": ["x", "rate"],
    "change": ["y"],
    "median": ["y", "median"],
    "mean": ["x", "mean"],
    "low_pass": ["y", "low_pass"],
    "quotient": ["x", "y"],
    "sum": ["x", "least"],
}
"""The slots, folds and samples (S30) that each number rests on."""
AGES = {"age_x": ("x", LONGEST - 1), "age_y": ("y", 700), "age_z": ("z", 1200)}
HELD = {
    "above_held": ("x_above", 300),
    "outside_held": ("x_outside", 400),
    "huge_held": ("y_huge", LONGEST - 1),
    "nested": ("above_held", 250),
    "sum_held": ("sum_above", 200),
}
"""The condition and the duration."""
SINCES = {
    "y_since_x": ("y_above", "x_above"),
    "not_inside_since_once": ("not_inside", "once"),
}
SWINGS = {"swing_y": ("y", 1.0, 2, 600), "swing_x": ("x", 0.5, 3, LONGEST - 1)}
EDGES = {"edges_x": ("x_above", 2, 700), "edges_held": ("above_held", 1, 100)}
PROPOSITIONS = [
    *LEAVES, *AGES, "always", "not_ever", *SWINGS, "not_inside", "above_held", "outside_held",
    "once", "huge_held", "nested", "y_since_x", "not_inside_since_once", "edges_x", "edges_held",
    "both", "either", "mixed", "sum_held",
]  # fmt: skip
"""In the order of monitor.c."""
WATCHED = ("swing_y", "nested")


@dataclass(frozen=True)
class Rule:
    """A rule: what activates it, what lets it clear (None: a reset), what its verdicts tell."""

    condition: str
    release: str | None
    terms: tuple[str, str]
    values: tuple[str, ...]
    input: str


RULES = (
    Rule("above_held", "always", ("x_above", "above_held"), ("x",), "x"),
    Rule("either", None, ("either", "swing_y"), ("quotient",), "x"),
    Rule("y_since_x", "once", ("y_since_x", "y_above"), ("y",), "y"),
    Rule("edges_x", "not_inside", ("edges_x", "x_above"), ("x",), "x"),
    Rule("mixed", "always", ("mixed", "changed"), ("change",), "y"),
    Rule("age_y", None, ("age_y", "always"), (), "y"),
    Rule("sum_held", "always", ("sum_held", "sum_above"), ("sum", "least"), "x"),
    Rule("both", "not_inside_since_once", ("both", "rate_above"), ("rate",), "x"),
    Rule("swing_x", "always", ("swing_x", "not_ever"), ("x",), "x"),
    Rule("age_z", "always", ("age_z", "z_above"), ("z",), "z"),
)


@dataclass(frozen=True)
class Event:
    """The report of a monitor."""

    change: int
    at_ns: int
    from_ns: int
    rule: int = 0
    propositions: tuple[int, ...] = (0, 0)
    since_ns: tuple[int, ...] = (0, 0)
    values: tuple[float, ...] = ()
    input: int = 0


@dataclass
class Recent:
    """Instants of turning points or edges; where a gap is, since when its source is known again."""

    instants: list[int] = field(default_factory=list)
    gap: int = FALSE
    gap_end_ns: int | None = None


def known(x: float) -> float:
    """S4."""
    return x if math.isfinite(x) else NAN


def both(a: int, b: int) -> int:
    """S2."""
    return FALSE if FALSE in (a, b) else max(a, b)


def either(a: int, b: int) -> int:
    """S2."""
    return TRUE if TRUE in (a, b) else max(a, b)


def opposite(a: int) -> int:
    """S2."""
    return {FALSE: TRUE, TRUE: FALSE}.get(a, a)


def divided(a: float, b: float) -> float:
    """IEEE 754 has quotients by zero; Python has not."""
    if b != 0.0:
        return a / b
    sign = math.copysign(1.0, a) * math.copysign(1.0, b)
    return NAN if a == 0.0 or math.isnan(a) else math.copysign(math.inf, sign)


def median(window: Sequence[float]) -> float:
    """S43."""
    if any(map(math.isnan, window)):
        return NAN
    ordered, count = sorted(window), len(window)
    a, b = ordered[(count - 1) // 2], ordered[count // 2]
    return a if a == b else a / 2 + b / 2


def mean(window: Sequence[float]) -> float:
    """S49."""
    total = window[0]
    for x in window[1:]:
        total += x
    return known(total / len(window))
