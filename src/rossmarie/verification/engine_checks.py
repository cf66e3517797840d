"""Checks of evaluation, of rules, and of the functions that process no message.

The input is the invariants of a machine; the result is C functions that begin in any state that
satisfies them.
"""

from __future__ import annotations

from collections.abc import Iterator

from rossmarie.ir import model as ir
from rossmarie.verification.check import Check, Parts, WrittenCheck
from rossmarie.verification.definitions import Definitions
from rossmarie.verification.events import Events
from rossmarie.verification.frames import FrameChecks
from rossmarie.verification.layout import ProofLayout
from rossmarie.verification.program import ANY, obligation
from rossmarie.verification.stages import (
    COUNTED_PARTS,
    RANGE,
    REFUSED,
    RESTS,
    begin,
    counts,
    stages,
)


class EngineChecks:
    """Writes these checks for one machine."""

    def __init__(
        self, layout: ProofLayout, definitions: Definitions, frames: FrameChecks, parts: Parts
    ) -> None:
        self._layout = layout
        self._frames = frames
        self._events = Events(layout, definitions)
        self._parts = parts
        self._machine = layout.machine
        self._definitions = definitions

    def written(self) -> Iterator[WrittenCheck]:
        """All checks of evaluation, rules and the interface."""
        yield from self._visits()
        parts = (("visit", "contract_visit"),)
        about = "all marked nodes are evaluated in order, and the evaluation ends"
        yield WrittenCheck(
            Check("evaluate", about, parts), f"{_EVALUATE}\n{self._frames.evaluated()}"
        )
        yield from self._public()

    # --- evaluation --------------------------------------------------------------------------

    def _visits(self) -> Iterator[WrittenCheck]:
        for proposition in (*self._layout.oscillations, *self._layout.derived):
            node = self._layout.node_of_proposition[proposition]
            about = f"`{self._machine.propositions[proposition].text}` is evaluated"
            yield WrittenCheck(Check(f"visit_{node}", about), self._visit(node))
        for index, rule in enumerate(self._machine.rules):
            node = self._layout.proposition_count + index
            about = f"rule {rule.name} is evaluated"
            yield WrittenCheck(Check(f"visit_{node}", about), self._visit(node))

    def _visit(self, node: int) -> str:
        rule = node - self._layout.proposition_count
        change = self._events.changed(rule) if rule >= 0 else "0"
        obligations = [
            obligation(f"events == {change}", "only a change of the rule is counted"),
            *self._events.reported({rule}),
            "    must_be_looked(m, t_ns);",
            obligation("!is_marked_up_to(m, node)", "the dependents of a node come after the node"),
            *(self._rule(index, node) for index in range(len(self._machine.rules))),
            *(self._before(k, node) for k in range(len(self._layout.held))),
            *(self._remembered(k, node) for k in range(len(self._layout.sinces))),
            self._frames.visited(node),
        ]
        pending = ""
        if not self._layout.is_small:
            pending = "    m->pending = true;\n"
            obligations.append(obligation("m->pending", "only `evaluate` clears `pending`"))
        return f"""\
{ANY}
    const unsigned node = {node};
    const monitor before = s;
    mark(m, node);
    suppose_looked(m, t_ns);
    s = before;
{pending}    __CPROVER_assume(m->now_ns == t_ns && !is_marked_up_to(m, node));
    const monitor old = s;
    const int events = visit(m, node, t_ns);
{chr(10).join(obligations)}"""

    def _rule(self, index: int, node: int) -> str:
        """S35 to S37: the rule changes as defined, and no other rule changes."""
        rule = self._machine.rules[index]
        condition = self._definitions.proposition(rule.condition)
        was, now = (f"(({m}active[{index // 8}] >> {index % 8} & 1) != 0)" for m in ("old.", "m->"))
        cleared = "false"
        if rule.release is not None:
            cleared = (
                f"{condition} == FALSE && {self._definitions.proposition(rule.release)} == TRUE"
            )
        becomes = f"({condition} == TRUE || {condition} == STALE || ({was} && !({cleared})))"
        mine = node == self._layout.proposition_count + index
        about = f"rule {rule.name} is active according to S35 to S37"
        return obligation(f"{now} == {becomes if mine else was}", about)

    def _before(self, k: int, node: int) -> str:
        """S33: the value of a duration's operand before the operand became true."""
        proposition = self._layout.held[k]
        declared = self._machine.propositions[proposition]
        assert isinstance(declared.node, ir.Held), "the layout lists durations"
        operand = self._definitions.proposition(declared.node.operand)
        was = f"old.held_before[{k}]"
        if node == self._layout.node_of_proposition[proposition]:
            was = f"({operand} != TRUE ? {operand} : {was})"
        return obligation(
            f"m->held_before[{k}] == {was}",
            f"`{declared.text}` keeps the value before it began (S33)",
        )

    def _remembered(self, k: int, node: int) -> str:
        """S44: the value of a `since` at the last evaluation."""
        proposition = self._layout.sinces[k]
        was = f"old.since_before[{k}]"
        if node == self._layout.node_of_proposition[proposition]:
            was = self._definitions.since_then(k, "old.")
        text = self._machine.propositions[proposition].text
        return obligation(f"m->since_before[{k}] == {was}", f"`{text}` remembers its value (S44)")

    # --- the interface -----------------------------------------------------------------------

    def _public(self) -> Iterator[WrittenCheck]:
        name = self._layout.name
        advance, reset = (
            f"{name}_advance(m, t_ns)",
            f"{name}_reset(m, t_ns, rule)",
        )
        yield from stages("advance", "time passes", advance, self._parts)
        parts = ((f"{name}_advance", "contract_advance"),)
        about = "an operator resets rules"
        call = f"    const int rule = nondet_integer();\n    const int events = {reset};"
        becomes = "({was} && {condition} != FALSE)"
        cleared = self._frames.latched("(rule < 0 || rule == {index})", becomes)
        lines = [f"{ANY}\n{RANGE}\n{call}", RESTS, "    const monitor old = base;", cleared]
        rules = range(len(self._machine.rules))
        count = " + ".join(["changes", *(f"(int){self._events.changed(rule)}" for rule in rules)])
        lines.append(obligation(f"events == {count}", "each cleared rule is counted"))
        lines += self._events.reported(set(rules))
        yield WrittenCheck(Check("reset", about, parts), "\n".join(lines))
        refused = Check("reset_refused", "a reset refuses an instant out of range", parts)
        yield WrittenCheck(
            refused, f"{ANY}\n    const int rule = nondet_integer();\n{REFUSED.format(call=reset)}"
        )
        yield WrittenCheck(Check("init", "a monitor is initialized"), self._init())
        yield WrittenCheck(Check("latch", "a rule is latched before the start"), self._latch())
        about = "the changes are counted when time passes"
        yield WrittenCheck(Check("advance_counts", about, COUNTED_PARTS), counts(advance))
        queries = f"""\
    const int64_t wake_ns = {name}_next_wake(m);
    __CPROVER_assert(!m->started || wake_ns > m->now_ns, "the next wake lies after the clock");
    const int which = nondet_integer();
    (void){name}_is_active(m, which);
    (void){name}_input_state(m, which);
    (void){name}_has_all_inputs(m);
    __CPROVER_assert(!is_calm(m, t_ns) || (t_ns >= m->now_ns && t_ns < m->wake_ns),
        "on the short path, time goes forward and no timer is due");
    must_be_same(m, &old);"""
        about = "queries do not change the monitor"
        yield WrittenCheck(Check("queries", about), f"{begin(self._layout)}\n{queries}")

    def _init(self) -> str:
        name = self._layout.name
        return f"""\
{ANY}
    (void)t_ns;
    const char *const fault = {name}_init(m, base.on_event, base.user);
    __CPROVER_assert(!fault, "the arithmetic is IEEE 754");
    __CPROVER_assert(m->on_event == base.on_event && m->user == base.user,
        "the monitor has its listener");
    __CPROVER_assert(!m->started && {name}_next_wake(m) == NEVER, "the monitor waits for no timer");
{self._nothing_was()}    for (int rule = 0; rule != RULES; rule++)
        __CPROVER_assert(!{name}_is_active(m, rule), "no rule is active");"""

    def _nothing_was(self) -> str:
        """S44: each `since` is false before the first evaluation."""
        obligations = (
            obligation(
                f"m->since_before[{k}] == FALSE", "each `since` is false before the start (S44)"
            )
            for k in range(len(self._layout.sinces))
        )
        return "".join(f"{each}\n" for each in obligations)

    def _latch(self) -> str:
        reported = self._frames.latched("(!old.started && rule == {index})", "true")
        call = f"{self._layout.name}_latch(m, rule);"
        any_rule = "    const int rule = nondet_integer();\n    const monitor old = s;"
        return f"{ANY}\n    (void)t_ns;\n{any_rule}\n    {call}\n{reported}"


_EVALUATE = """\
    monitor s = any();
    monitor *const m = &s;
    const int64_t t_ns = nondet_instant();
    asked_ns = t_ns;
    suppose_marks(m, t_ns);
    const monitor old = s;
    due = s;
    const int events = evaluate(m, t_ns);
    __CPROVER_assert(events == changes, "changes are counted");
    must_be_due(m, PROPOSITIONS + RULES);
    must_be_unmarked(m, t_ns);"""
