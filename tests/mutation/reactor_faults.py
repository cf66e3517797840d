"""Faults of a reactor: what a generator that errs might have written for `rules.ross`."""

from __future__ import annotations

from mutation.faults import Fault


def _reactor(name: str, old: str, new: str) -> Fault:
    return Fault(name, old, new, part="reactor")


REACTOR = (
    _reactor("the greater is the lesser", "return b < a ? b : a;", "return b > a ? b : a;"),
    _reactor("low ends combine to the least", "b->low = greater(", "b->low = lesser("),
    _reactor("a released limit closes in", "limit_high[i] + gone", "limit_high[i] - gone"),
    _reactor("a ramp of milliseconds", "(t_ns - since_ns) / 1e9", "(t_ns - since_ns) / 1e6"),
    _reactor(
        "a limit fades while it is in force",
        "if (r->state[task] == HOLDING)\n        return 0.0;",
        "",
    ),
    _reactor("a limit of another action", "limit_high[6] = {0.4,", "limit_high[6] = {0.5,"),
    _reactor("factors multiply bounds", "value * b.factor, b.low", "value, b.low * b.factor"),
    _reactor("what is not finite passes", "isfinite(value) ?", "!isnan(value) ?"),
    _reactor("commands pass before all is known", "= r->opened && t_ns", "= t_ns"),
    _reactor(
        "the lower rule gets what both need",
        "claiming_rules[3] = {1, 0,",
        "claiming_rules[3] = {0, 1,",
    ),
    _reactor("rules begin in the wrong order", "rule_order[7] = {1, 0,", "rule_order[7] = {0, 1,"),
    _reactor("an overruled task is not given up", "            give_up(r, task);\n", ""),
    _reactor(
        "a waiting task never begins again",
        "r->state[task] == WAITING && overruler(r, task) < 0",
        "false",
    ),
    _reactor(
        "a failure has no consequence",
        "        start(r, &escalations[",
        "        (void)(&escalations[",
    ),
    _reactor(
        "a task that ran out of time goes on",
        "else if (r->now_ns >= due_ns)",
        "else if (r->now_ns > due_ns)",
    ),
    _reactor(
        "a success in time is too late",
        "r->now_ns <= due_ns && r->reported",
        "r->now_ns < due_ns && r->reported",
    ),
    _reactor("an unknown confirmation will do", "== rules_TRUE", "!= rules_FALSE"),
    _reactor("a report is remembered from the last time", "    r->reported[task] = false;\n", ""),
    _reactor(
        "what started first is stopped first",
        "const unsigned task = started[i - 1];",
        "const unsigned task = started[r->started_count[rule] - i];",
    ),
    _reactor("a release undoes nothing", "            decide(r, task, rules_STOP, -1);\n", ""),
    _reactor("`unless` is overlooked", "if (engages(m, exempted, others[i]))", "if (false)"),
    _reactor("an exempted rule acts", "&& !(exempted && exempted[rule])", ""),
    _reactor("a rule begins where it left off", "            r->stage[rule] = 0;\n", ""),
    _reactor(
        "the next stage does not wait",
        "state != HOLDING && state != WAITING",
        "state != RUNNING && state != HOLDING && state != WAITING",
    ),
    _reactor(
        "a jump back makes tasks younger",
        "            r->since_ns[task] = t_ns - (age",
        "            (void)(age",
    ),
    _reactor("the next wake forgets a task", "due_ns < wake_ns ? due_ns : wake_ns", "wake_ns"),
)
