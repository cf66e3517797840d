"""Checks of time: of timers, and of the first instant.

The input is the invariants of a machine; the result is C functions that begin in any state that
satisfies them.
"""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie.verification.check import Check, Parts, WrittenCheck
from rossmarie.verification.frames import FrameChecks
from rossmarie.verification.layout import ProofLayout
from rossmarie.verification.program import ANY
from rossmarie.verification.stages import AS_IT_WAS, REFUSED, RESTS, WAITS

_EARLIEST = ("earliest_timer", "contract_earliest_timer")


class TimeChecks:
    """Writes these checks for one machine."""

    def __init__(self, layout: ProofLayout, frames: FrameChecks, parts: Parts) -> None:
        self._layout = layout
        self._frames = frames
        self._parts = parts

    def written(self) -> Iterator[WrittenCheck]:
        """All checks of time."""
        tick = Check("tick", "timers are handled", self._parts)
        yield WrittenCheck(tick, f"{ANY}\n{_TICK}\n{self._frames.ticked()}")
        restart = Check("restart", "a monitor starts or restarts", self._parts)
        yield WrittenCheck(restart, self._restart())
        yield from self._earliest()
        yield from self._catch_up()

    def _restart(self) -> str:
        name = self._layout.name
        return f"""\
{ANY}
    __CPROVER_assume(t_ns > EARLIEST && t_ns < LATEST);
    if (nondet_number() % 2) {{
        {name}_init(m, observe, &base);
        {name}_latch(m, nondet_integer());
    }} else {{
        __CPROVER_assume(t_ns < m->now_ns);
        suppose_at_rest(m, m->now_ns);
    }}
    const monitor old = s;
    restart(m, t_ns);
    must_be_restarted(m, t_ns);
    must_be_unlooked(m, t_ns);
{self._frames.restarted()}"""

    def _earliest(self) -> Iterator[WrittenCheck]:
        yield WrittenCheck(Check("earlier", "the earlier of two instants"), _EARLIER)
        check = Check("waiting", "values stay right until a timer is due")
        yield WrittenCheck(check, f"{ANY}\n{WAITS}\n{_WAITING}")
        check = Check("resting", "no timer is due while a monitor is at rest")
        yield WrittenCheck(check, f"{ANY}\n{_RESTING}")
        parts: Parts = (("earlier", "contract_earlier"),)
        check = Check("earliest_timer", "no timer lies before the earliest timer", parts)
        yield WrittenCheck(check, f"{ANY}\n{_EARLIEST_TIMER}")
        check = Check("set_wake", "the instant of the next timer is set", (_EARLIEST,))
        yield WrittenCheck(check, f"{ANY}\n{_SET_WAKE}\n{self._frames.woken()}")

    def _catch_up(self) -> Iterator[WrittenCheck]:
        """One pass of the loop stands for all passes: it begins and ends with a monitor at rest."""
        about = "an instant out of range is refused"
        refused = REFUSED.format(call="catch_up(m, t_ns)")
        yield WrittenCheck(Check("catch_up_refused", about, _NOTHING), f"{ANY}\n{refused}")
        forward: Parts = (_EARLIEST, ("restart", "never_restart"))
        timer = ("earliest_timer", "any_timer")
        for name, about, passes, parts, body in (
            ("anew", "a monitor starts or restarts", 1, _ANEW, f"{ANY}\n{_CATCH_UP_ANEW}"),
            ("ends", "no due timer is left", 1, (*forward, ("tick", "never_tick")), _CATCH_UP_ENDS),
            ("tick", "the first due timer", 1, (*forward, ("tick", "tick_and_end")), _CATCHES_UP),
            ("ticked", "propositions are evaluated", 1, (timer, *_TICKED), _CATCHES_UP),
            ("pass", "each timer in its turn", 2, _PASS, f"{ANY}\n{_CATCH_UP_PASS}"),
        ):
            said = f"timers that are due before an instant run: {about}"
            loops = (("catch_up.0", passes),)
            yield WrittenCheck(Check(f"catch_up_{name}", said, parts, (), loops), body)


_TICK = """\
    __CPROVER_assume(t_ns > EARLIEST && t_ns < LATEST);
    suppose_unlooked(m, t_ns);
    const monitor old = s;
    tick(m, t_ns);
    must_be_looked(m, t_ns);"""

_EARLIER = """\
    const int64_t a = nondet_instant(), b = nondet_instant(), t_ns = nondet_instant();
    const int64_t found_ns = earlier(a, b);
    __CPROVER_assert((found_ns < t_ns) == (a < t_ns || b < t_ns),
        "the result is not later than either");
    __CPROVER_assert((found_ns > t_ns) == (a > t_ns && b > t_ns),
        "the result is not before both");"""

_RESTING = """\
    __CPROVER_assume(t_ns == m->now_ns);
    suppose_at_rest(m, t_ns);
    must_be_ahead(m, t_ns + 1);"""

_WAITING = """\
    suppose_at_rest(m, m->now_ns);
    must_be_at_rest(m, t_ns);"""

_EARLIEST_TIMER = """\
    suppose_unmarked(m, t_ns);
    suppose_clock(m, t_ns);
    suppose_recent(m, t_ns);
    suppose_ahead(m, m->now_ns + 1);
    before_ns = nondet_instant();
    after_ns = m->now_ns;
    const int64_t wake_ns = earliest_timer(m);
    __CPROVER_assert(wake_ns > m->now_ns, "the earliest timer lies after the clock");
    __CPROVER_assume(wake_ns >= before_ns);
    must_be_ahead(m, before_ns);"""

_SET_WAKE = f"""\
    __CPROVER_assume(t_ns == m->now_ns);
    suppose_at_rest(m, t_ns);
    const monitor old = s;
    set_wake(m);
{RESTS}"""

_CATCH_UP_ANEW = """\
    __CPROVER_assume(t_ns > EARLIEST && t_ns < LATEST);
    __CPROVER_assume(!m->started || t_ns < m->now_ns);
    suppose_anew(m, t_ns);
    const monitor old = s;
    const int events = catch_up(m, t_ns);
    __CPROVER_assert(m->now_ns <= t_ns, "the clock does not pass the instant");
    must_be_unlooked(m, t_ns);
    must_be_same(m, &anew);
    __CPROVER_assert(events == (old.started ? 1 : 0), "a time jump is counted");
    __CPROVER_assert(jumps == (old.started && m->on_event ? 1 : 0), "a time jump is reported once");
    __CPROVER_assert(!jumps || (jump.at_ns == t_ns && jump.from_ns == old.now_ns),
        "the report of a time jump has both instants");"""

_NOTHING = (("restart", "never_restart"), ("earliest_timer", "never_timer"))
_ANEW = (("restart", "contract_restart"), ("tick", "never_tick"))
_TICKED = (("restart", "never_restart"), ("tick", "ticked"), ("evaluate", "end_at_evaluate"))
_PASS = (
    ("restart", "never_restart"),
    ("earliest_timer", "timer_of_a_pass"),
    ("tick", "tick_once"),
    ("evaluate", "evaluated_somehow"),
)

_CATCHES_UP = f"""\
{ANY}
    __CPROVER_assume(t_ns > EARLIEST && t_ns < LATEST && m->now_ns <= t_ns);
    suppose_at_rest(m, m->now_ns);
    const int events = catch_up(m, t_ns);"""

_CATCH_UP_ENDS = f"""\
{_CATCHES_UP}
    __CPROVER_assert(events == 0, "no change is counted");
    __CPROVER_assert(m->now_ns <= t_ns, "the clock does not pass the instant");
    must_be_unlooked(m, t_ns);
{AS_IT_WAS}"""

_CATCH_UP_PASS = f"""\
    __CPROVER_assume(t_ns > EARLIEST && t_ns < LATEST && m->started && m->now_ns <= t_ns);
    const int events = catch_up(m, t_ns);
    __CPROVER_assume(is_late);
    __CPROVER_assert(events == changes, "changes are counted");
    __CPROVER_assert(m->now_ns < t_ns, "the clock does not pass the instant");
{AS_IT_WAS}"""
