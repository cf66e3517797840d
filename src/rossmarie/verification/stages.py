"""The checks of a function with an instant, in stages. Each stage has only its own dependencies.

The input is a call of the function; the result is the checks of its stages. Contracts replace the
function's parts.
"""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie.verification.check import Check, Parts, WrittenCheck
from rossmarie.verification.guard_checks import unlooked
from rossmarie.verification.layout import ProofLayout
from rossmarie.verification.program import ANY

_SOMEHOW = (("catch_up", "caught_up_somehow"), ("tick", "ticked_somehow"))

COUNTED_PARTS = (
    ("evaluate", "count_evaluated"),
    ("tick", "ignore_tick"),
    ("catch_up", "count_caught_up"),
    ("arrive", "ignore_arrive"),
    ("set_wake", "ignore_wake"),
)
"""The contracts for the parts of a function that takes an instant, for checks of its result
only.
"""


def begin(layout: ProofLayout) -> str:
    """A monitor that has not started, or that is at rest."""
    return f"""\
{ANY}
    if (nondet_number() % 2) {{
        {layout.name}_init(m, observe, &base);
        {layout.name}_latch(m, nondet_integer());
    }} else {{
        suppose_at_rest(m, m->now_ns);
    }}
    const monitor old = s;"""


RANGE = "    __CPROVER_assume(t_ns > EARLIEST && t_ns < LATEST);"
IN_RANGE = "    __CPROVER_assume(m->now_ns > EARLIEST && m->wake_ns <= LATEST);"
"""The instants of a monitor at rest lie in this range."""

_CLOCK = '    __CPROVER_assert(m->now_ns == t_ns, "the clock is set");'
RESTS = f"{_CLOCK}\n    must_be_at_rest(m, t_ns);"

_REPORTED = "    must_be_reported(m, &base);"
AS_IT_WAS = "    must_be_same(m, &base);"

REFUSED = """\
    __CPROVER_assume(t_ns <= EARLIEST || t_ns >= LATEST);
    const monitor old = s;
    __CPROVER_assert({call} < 0, "an instant out of range is refused");
    must_be_same(m, &old);"""
"""The outcome of a call at an instant out of range."""

WAITS = "    __CPROVER_assume(t_ns >= m->now_ns && t_ns < m->wake_ns);"
"""No timer is due at an instant."""


def stages(
    name: str, about: str, call: str, parts: Parts, lines: str = "", idle: Parts = ()
) -> Iterator[WrittenCheck]:
    """The checks that a call at an instant in range leaves a monitor at rest. `idle` replaces parts
    that matter only until propositions are evaluated.
    """
    body = f"{ANY}\n{lines}\n{RANGE}\n    (void){call};"
    replaced = (("catch_up", "caught_up"), ("tick", "end_at_tick"))
    check = Check(f"{name}_before", f"{about}, until timers are handled", (*parts, *replaced))
    yield WrittenCheck(check, body)
    replaced = (("catch_up", "caught_up_somehow"), ("tick", "ticked"))
    yield between(name, about, f"{body}\n{RESTS}", (*parts, *replaced))
    yield after(name, about, body, (*parts, *idle))


def between(name: str, about: str, body: str, parts: Parts) -> WrittenCheck:
    """The check of a call until propositions are evaluated. The program knows about inputs only
    what the message reports.
    """
    replaced = (*parts, ("evaluate", "end_at_evaluate"), ("set_wake", "end_at_set_wake"))
    return WrittenCheck(
        Check(f"{name}_between", f"{about}, until propositions are evaluated", replaced),
        f"{body}\n{_REPORTED}",
    )


def after(name: str, about: str, body: str, parts: Parts) -> WrittenCheck:
    """The check of a call after propositions are evaluated. Facts that held when propositions were
    evaluated, or when the next timer was set, still hold, because nothing has changed them.
    """
    given = dict(parts)
    somehow = tuple(pair for pair in _SOMEHOW if pair[0] not in given)
    late = (
        ("is_pending", "maybe_pending"),
        ("evaluate", "evaluated_somehow"),
        ("set_wake", "set_wake_somehow"),
    )
    about = f"{about}, after propositions are evaluated"
    check = Check(f"{name}_after", about, (*unlooked(parts), *somehow, *late))
    lines = [body, "    __CPROVER_assume(is_late);", _CLOCK, AS_IT_WAS]
    return WrittenCheck(check, "\n".join(lines))


def counts(call: str) -> str:
    """The check that a call returns the number of changes, and refuses an instant out of range."""
    return f"""\
{ANY}
{IN_RANGE}
    const monitor old = s;
    const int events = {call};
    const bool is_in_range = t_ns > EARLIEST && t_ns < LATEST;
    __CPROVER_assert(events == (is_in_range ? changes : -1),
        "changes are counted, and an instant out of range is refused");
    if (!is_in_range)
        must_be_same(m, &old);"""
