"""What is to be shown of evaluation, of time and of rules: the parts that no message is in.

Takes the invariants of a machine; gives C functions that begin in any state that fits them.
"""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie import ir
from rossmarie.targets.c99.layout import Layout
from rossmarie.verification.check import Check, Written
from rossmarie.verification.definitions import Definitions
from rossmarie.verification.program import claim

_ANY = """\
    monitor s = any();
    monitor *const m = &s;
    const int64_t t_ns = nondet_instant();"""

PUBLIC_PARTS = (
    ("evaluate", "contract_evaluate"),
    ("tick", "contract_tick"),
    ("catch_up", "contract_catch_up"),
)
"""What stands in for the parts that every function which takes an instant calls."""


def begin(layout: Layout) -> str:
    """A monitor that has not started, or one at rest."""
    return f"""\
{_ANY}
    if (nondet_number() % 2) {{
        {layout.name}_init(m, observe, NULL);
        {layout.name}_latch(m, nondet_integer());
    }} else {{
        suppose_at_rest(m, m->now_ns);
    }}
    const monitor old = s;"""


END = """\
    if (events < 0) {
        __CPROVER_assert(t_ns <= EARLIEST || t_ns >= LATEST, "what is in range is taken");
    } else {
        __CPROVER_assert(m->now_ns == t_ns, "the clock is set");
        must_be_at_rest(m, t_ns);
    }"""


class EngineChecks:
    """Writes these checks for one machine."""

    def __init__(self, layout: Layout, definitions: Definitions) -> None:
        self._layout = layout
        self._machine = layout.machine
        self._definitions = definitions

    def written(self) -> Iterator[Written]:
        """All of them."""
        yield from self._visits()
        parts = (("visit", "contract_visit"),)
        about = "everything that is marked is evaluated, in order, and that ends"
        yield Written(Check("evaluate", about, parts), _EVALUATE)
        yield Written(Check("tick", "timers are looked at"), f"{_ANY}\n{_TICK}")
        yield Written(Check("restart", "time begins, or begins again"), self._restart())
        yield self._catch_up()
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
        ]
        return f"""\
{_ANY}
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
{_ANY}
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
    must_not_act(m, &old);"""

    def _catch_up(self) -> Written:
        """One pass of its loop stands for all: it begins in any state that a pass can end in."""
        parts = tuple((part, f"contract_{part}") for part in ("evaluate", "tick", "restart"))
        about = "timers that are due before an instant run one after the other"
        body = f"{begin(self._layout)}\n{_CATCH_UP}"
        return Written(Check("catch_up", about, parts, unwound=(("catch_up.0", 2),)), body)

    # --- the interface -----------------------------------------------------------------------

    def _public(self) -> Iterator[Written]:
        name, start = self._layout.name, begin(self._layout)
        call = f"    const int events = {name}_advance(m, t_ns);"
        yield Written(Check("advance", "time passes", PUBLIC_PARTS), "\n".join([start, call, END]))
        call = f"    const int events = {name}_reset(m, t_ns, nondet_integer());"
        parts = ((f"{name}_advance", "contract_advance"),)
        yield Written(Check("reset", "an operator resets", parts), "\n".join([start, call, END]))
        questions = f"""\
    const int64_t wake_ns = {name}_next_wake(m);
    __CPROVER_assert(!m->started || wake_ns > m->now_ns, "what comes next lies ahead");
    const int which = nondet_integer();
    (void){name}_is_active(m, which);
    (void){name}_input_state(m, which);
    (void){name}_has_all_inputs(m);
    __CPROVER_assert(old.now_ns == m->now_ns, "to ask changes nothing");"""
        about = "questions that change nothing"
        yield Written(Check("questions", about), f"{start}\n{questions}")


_EVALUATE = """\
    monitor s = any();
    const int64_t t_ns = nondet_instant();
    suppose_marks(&s, t_ns);
    const int events = evaluate(&s, t_ns);
    __CPROVER_assert(events >= 0 && events <= TRUTHS + RULES, "changes are counted");
    __CPROVER_assert(s.now_ns == t_ns, "the clock is set");
    must_be_unmarked(&s, t_ns);"""

_TICK = """\
    __CPROVER_assume(t_ns > EARLIEST && t_ns < LATEST);
    suppose_unlooked(m, t_ns);
    const monitor old = s;
    tick(m, t_ns);
    must_be_looked(m, t_ns);
    must_not_act(m, &old);"""

_CATCH_UP = """\
    const int events = catch_up(m, t_ns);
    const bool is_in_range = t_ns > EARLIEST && t_ns < LATEST;
    __CPROVER_assert((events >= 0) == is_in_range, "what is out of range is refused");
    if (events >= 0) {
        if (!old.started || t_ns < old.now_ns)
            must_be_restarted(m, t_ns);
        else
            must_be_at_rest(m, m->now_ns);
        must_be_unlooked(m, t_ns);
    }"""
