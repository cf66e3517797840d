"""What is to be shown of evaluation, of time and of rules: the parts that no message is in.

Takes the invariants of a machine; gives C functions that begin in any state that fits them.
"""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie import ir
from rossmarie.targets.c99 import state
from rossmarie.targets.c99.layout import Layout
from rossmarie.verification.check import Check, Parts, Written
from rossmarie.verification.definitions import Definitions
from rossmarie.verification.frames import Frames
from rossmarie.verification.guard_checks import unlooked
from rossmarie.verification.program import ANY, claim

_SOMEHOW = (("catch_up", "caught_up_somehow"), ("tick", "ticked_somehow"))
_EARLIEST = ("earliest_timer", "contract_earliest_timer")

COUNTED_PARTS = (
    ("evaluate", "count_evaluated"),
    ("tick", "ignore_tick"),
    ("catch_up", "count_caught_up"),
    ("arrive", "ignore_arrive"),
    ("set_wake", "ignore_wake"),
)
"""What stands in for the parts of a function that takes an instant, where only what it returns
matters.
"""


def begin(layout: Layout) -> str:
    """A monitor that has not started, or one at rest."""
    return f"""\
{ANY}
    if (nondet_number() % 2) {{
        {layout.name}_init(m, observe, NULL);
        {layout.name}_latch(m, nondet_integer());
    }} else {{
        suppose_at_rest(m, m->now_ns);
    }}
    const monitor old = s;"""


_RANGE = "    __CPROVER_assume(t_ns > EARLIEST && t_ns < LATEST);"
IN_RANGE = "    __CPROVER_assume(m->now_ns > EARLIEST && m->wake_ns <= LATEST);"
"""What is known of the instants of any monitor at rest."""

RESTS = """\
    __CPROVER_assert(m->now_ns == t_ns, "the clock is set");
    must_be_at_rest(m, t_ns);"""

_TOLD = "    must_be_told(m, &base);"
_AS_IT_WAS = "    must_be_same(m, &base);"

WAITS = "    __CPROVER_assume(t_ns >= m->now_ns && t_ns < m->wake_ns);"
"""No timer is due at an instant."""


def stages(
    name: str, about: str, call: str, parts: Parts, lines: str = "", idle: Parts = ()
) -> Iterator[Written]:
    """A call at an instant in range leaves a monitor at rest behind; `idle` replaces what matters
    only until truths are evaluated.
    """
    body = f"{ANY}\n{lines}\n{_RANGE}\n    (void){call};"
    replaced = (("catch_up", "caught_up"), ("tick", "end_at_tick"))
    check = Check(f"{name}_before", f"{about}, until timers are looked at", (*parts, *replaced))
    yield Written(check, body)
    replaced = (("catch_up", "caught_up_somehow"), ("tick", "ticked"))
    yield between(name, about, f"{body}\n{RESTS}", (*parts, *replaced))
    yield after(name, about, body, (*parts, *idle))


def between(name: str, about: str, body: str, parts: Parts) -> Written:
    """The same, until truths are evaluated: of inputs it is known what the message says."""
    replaced = (*parts, ("evaluate", "end_at_evaluate"), ("set_wake", "end_at_set_wake"))
    return Written(
        Check(f"{name}_between", f"{about}, until truths are evaluated", replaced),
        f"{body}\n{_TOLD}",
    )


def after(name: str, about: str, body: str, parts: Parts) -> Written:
    """The same, from then on."""
    given = dict(parts)
    somehow = tuple(pair for pair in _SOMEHOW if pair[0] not in given)
    late = (
        ("is_pending", "maybe_pending"),
        ("evaluate", "evaluated"),
        ("set_wake", "set_wake_somehow"),
    )
    about = f"{about}, after truths are evaluated"
    check = Check(f"{name}_after", about, (*unlooked(parts), *somehow, *late))
    return Written(check, f"{body}\n    __CPROVER_assume(is_late);\n{RESTS}\n{_AS_IT_WAS}")


def counts(call: str) -> str:
    """A call tells how much has changed, and refuses an instant out of range."""
    return f"""\
{ANY}
{IN_RANGE}
    const monitor old = s;
    const int events = {call};
    const bool is_in_range = t_ns > EARLIEST && t_ns < LATEST;
    __CPROVER_assert((events >= 0) == is_in_range, "what is out of range is refused");
    if (!is_in_range)
        must_be_same(m, &old);"""


class EngineChecks:
    """Writes these checks for one machine."""

    def __init__(
        self, layout: Layout, definitions: Definitions, frames: Frames, parts: Parts
    ) -> None:
        self._layout = layout
        self._frames = frames
        self._parts = parts
        self._machine = layout.machine
        self._definitions = definitions

    def written(self) -> Iterator[Written]:
        """All of them."""
        yield from self._visits()
        parts = (("visit", "contract_visit"),)
        about = "everything that is marked is evaluated, in order, and that ends"
        yield Written(Check("evaluate", about, parts), f"{_EVALUATE}\n{self._frames.evaluated()}")
        tick = Check("tick", "timers are looked at", self._parts)
        yield Written(tick, f"{ANY}\n{_TICK}\n{self._frames.ticked()}")
        restart = Check("restart", "time begins, or begins again", self._parts)
        yield Written(restart, self._restart())
        yield from self._earliest()
        yield from self._catch_up()
        yield from self._public()

    # --- evaluation --------------------------------------------------------------------------

    def _visits(self) -> Iterator[Written]:
        for truth in (*self._layout.oscillations, *self._layout.derived):
            node = self._layout.node_of_truth[truth]
            about = f"`{self._machine.truths[truth].text}` is evaluated"
            yield Written(Check(f"visit_{node}", about), self._visit(node))
        for index, rule in enumerate(self._machine.rules):
            node = self._layout.truth_count + index
            about = f"rule {rule.name} is judged"
            yield Written(Check(f"visit_{node}", about), self._visit(node))

    def _visit(self, node: int) -> str:
        claims = [
            claim("events == 0 || events == 1", "at most one change"),
            "    must_be_looked(m, t_ns);",
            claim("!is_marked_up_to(m, node)", "what depends on a truth stands behind it"),
            *(self._rule(index, node) for index in range(len(self._machine.rules))),
            *(self._before(k, node) for k in range(len(self._layout.held))),
            self._frames.visited(node),
        ]
        return f"""\
{ANY}
    const unsigned node = {node};
    const monitor before = s;
    mark(m, node);
    suppose_looked(m, t_ns);
    s = before;
    __CPROVER_assume(m->now_ns == t_ns && !is_marked_up_to(m, node));
    const monitor old = s;
    const int events = visit(m, node, t_ns);
{chr(10).join(claims)}"""

    def _rule(self, index: int, node: int) -> str:
        """S35 to S37, and that no other rule changes."""
        rule = self._machine.rules[index]
        condition = self._definitions.truth(rule.condition)
        was, now = (f"(({m}active[{index // 8}] >> {index % 8} & 1) != 0)" for m in ("old.", "m->"))
        cleared = "false"
        if rule.release is not None:
            cleared = f"{condition} == FALSE && {self._definitions.truth(rule.release)} == TRUE"
        becomes = f"({condition} == TRUE || {condition} == LOST || ({was} && !({cleared})))"
        mine = node == self._layout.truth_count + index
        about = f"rule {rule.name} is active as S35 to S37 say"
        return claim(f"{now} == {becomes if mine else was}", about)

    def _before(self, k: int, node: int) -> str:
        """S33: what the operand of a duration was before it was true."""
        truth = self._layout.held[k]
        declared = self._machine.truths[truth]
        assert isinstance(declared.node, ir.Held), "the layout lists durations"
        operand = self._definitions.truth(declared.node.operand)
        was = f"old.held_before[{k}]"
        if node == self._layout.node_of_truth[truth]:
            was = f"({operand} != TRUE ? {operand} : {was})"
        return claim(f"m->held_before[{k}] == {was}", f"what `{declared.text}` was before")

    # --- time --------------------------------------------------------------------------------

    def _restart(self) -> str:
        name = self._layout.name
        return f"""\
{ANY}
    __CPROVER_assume(t_ns > EARLIEST && t_ns < LATEST);
    if (nondet_number() % 2) {{
        {name}_init(m, observe, NULL);
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

    def _earliest(self) -> Iterator[Written]:
        parts: Parts = ()
        if "earlier" in state.parts(self._layout):
            parts = (("earlier", "contract_earlier"),)
            yield Written(Check("earlier", "the earlier of two instants"), _EARLIER)
        check = Check("waiting", "what is right stays so until a timer is due")
        yield Written(check, f"{ANY}\n{WAITS}\n{_WAITING}")
        check = Check("resting", "no timer is due while a monitor is at rest")
        yield Written(check, f"{ANY}\n{_RESTING}")
        check = Check("earliest_timer", "no timer lies before the earliest", parts)
        yield Written(check, f"{ANY}\n{_EARLIEST_TIMER}")
        check = Check("set_wake", "the instant of the next timer is set", (_EARLIEST,))
        yield Written(check, f"{ANY}\n{_SET_WAKE}\n{self._frames.woken()}")

    def _catch_up(self) -> Iterator[Written]:
        """One pass of its loop stands for all: it begins with a monitor at rest, and leaves one
        behind.
        """
        about = "an instant out of range is refused"
        yield Written(Check("catch_up_refused", about, _NOTHING), f"{ANY}\n{_REFUSED}")
        forward: Parts = (_EARLIEST, ("restart", "never_restart"))
        timer = ("earliest_timer", "any_timer")
        for name, about, passes, parts, body in (
            ("anew", "time begins, or begins again", 1, _ANEW, f"{ANY}\n{_CATCH_UP_ANEW}"),
            ("ends", "none is left", 1, (*forward, ("tick", "never_tick")), _CATCH_UP_ENDS),
            ("tick", "one of them", 1, (*forward, ("tick", "tick_and_end")), _CATCHES_UP),
            ("ticked", "truths are evaluated then", 1, (timer, *_TICKED), _CATCHES_UP),
            ("pass", "one after the other", 2, (*forward, *_PASS), _CATCH_UP_PASS),
        ):
            said = f"timers that are due before an instant run: {about}"
            loops = (("catch_up.0", passes),)
            yield Written(Check(f"catch_up_{name}", said, parts, (), loops), body)

    # --- the interface -----------------------------------------------------------------------

    def _public(self) -> Iterator[Written]:
        name = self._layout.name
        advance, reset = (
            f"{name}_advance(m, t_ns)",
            f"{name}_reset(m, t_ns, rule)",
        )
        yield from stages("advance", "time passes", advance, self._parts)
        parts = ((f"{name}_advance", "contract_advance"),)
        about = "an operator resets"
        lines = [f"{ANY}\n{_RANGE}\n    const int rule = nondet_integer();\n    (void){reset};"]
        becomes = "({was} && {condition} != FALSE)"
        cleared = self._frames.latched("(rule < 0 || rule == {index})", becomes)
        lines += [RESTS, "    const monitor old = base;", cleared]
        yield Written(Check("reset", about, parts), "\n".join(lines))
        body = f"    const int rule = nondet_integer();\n{counts(reset)}"
        yield Written(Check("reset_counts", f"{about}: changes are counted", parts), body)
        yield Written(Check("latch", "a rule is told to be latched"), self._latch())
        about = "the changes are counted when time passes"
        yield Written(Check("advance_counts", about, COUNTED_PARTS), counts(advance))
        questions = f"""\
    const int64_t wake_ns = {name}_next_wake(m);
    __CPROVER_assert(!m->started || wake_ns > m->now_ns, "what comes next lies ahead");
    const int which = nondet_integer();
    (void){name}_is_active(m, which);
    (void){name}_input_state(m, which);
    (void){name}_has_all_inputs(m);
    __CPROVER_assert(!is_calm(m, t_ns) || (t_ns >= m->now_ns && t_ns < m->wake_ns),
        "where the short way is taken, time goes forward and nothing is due");
    must_be_same(m, &old);"""
        about = "questions that change nothing"
        yield Written(Check("questions", about), f"{begin(self._layout)}\n{questions}")

    def _latch(self) -> str:
        told = self._frames.latched("(!old.started && rule == {index})", "true")
        call = f"{self._layout.name}_latch(m, rule);"
        any_rule = "    const int rule = nondet_integer();\n    const monitor old = s;"
        return f"{ANY}\n    (void)t_ns;\n{any_rule}\n    {call}\n{told}"


_EVALUATE = """\
    monitor s = any();
    monitor *const m = &s;
    const int64_t t_ns = nondet_instant();
    suppose_marks(m, t_ns);
    const monitor old = s;
    const int events = evaluate(m, t_ns);
    __CPROVER_assert(events >= 0 && events <= TRUTHS + RULES, "changes are counted");
    must_be_unmarked(m, t_ns);"""

_TICK = """\
    __CPROVER_assume(t_ns > EARLIEST && t_ns < LATEST);
    suppose_unlooked(m, t_ns);
    const monitor old = s;
    tick(m, t_ns);
    must_be_looked(m, t_ns);"""

_EARLIER = """\
    const int64_t a = nondet_instant(), b = nondet_instant(), t_ns = nondet_instant();
    const int64_t found_ns = earlier(a, b);
    __CPROVER_assert((found_ns < t_ns) == (a < t_ns || b < t_ns), "it is not later than either");
    __CPROVER_assert((found_ns > t_ns) == (a > t_ns && b > t_ns), "it is not before both");"""

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
    suppose_swings(m, t_ns);
    suppose_ahead(m, m->now_ns + 1);
    before_ns = nondet_instant();
    after_ns = m->now_ns;
    const int64_t wake_ns = earliest_timer(m);
    __CPROVER_assert(wake_ns > m->now_ns, "it lies ahead");
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
    (void)catch_up(m, t_ns);
    __CPROVER_assert(m->now_ns <= t_ns, "the clock is not ahead");
    must_be_unlooked(m, t_ns);
    must_be_same(m, &anew);"""

_NOTHING = (("restart", "never_restart"), ("earliest_timer", "never_timer"))
_ANEW = (("restart", "contract_restart"), ("tick", "never_tick"))
_TICKED = (("restart", "never_restart"), ("tick", "ticked"), ("evaluate", "end_at_evaluate"))
_PASS = (("tick", "tick_once"), ("evaluate", "evaluated"))

_CATCHES_UP = f"""\
{ANY}
    __CPROVER_assume(t_ns > EARLIEST && t_ns < LATEST && m->now_ns <= t_ns);
    suppose_at_rest(m, m->now_ns);
    (void)catch_up(m, t_ns);"""

_CATCH_UP_ENDS = f"""\
{_CATCHES_UP}
    __CPROVER_assert(m->now_ns <= t_ns, "the clock is not ahead");
    must_be_unlooked(m, t_ns);
{_AS_IT_WAS}"""

_CATCH_UP_PASS = f"""\
{_CATCHES_UP}
    __CPROVER_assume(is_late);
    __CPROVER_assert(m->now_ns <= t_ns, "the clock is not ahead");
    must_be_unlooked(m, t_ns);
{_AS_IT_WAS}"""

_REFUSED = """\
    __CPROVER_assume(t_ns <= EARLIEST || t_ns >= LATEST);
    const monitor old = s;
    __CPROVER_assert(catch_up(m, t_ns) < 0, "what is out of range is refused");
    must_be_same(m, &old);"""
