"""Faults of a reactor: what a generator that errs might have written for `rules.ross`."""

from __future__ import annotations

from mutation.faults import Fault


def _reactor(name: str, old: str, new: str) -> Fault:
    return Fault(name, old, new, part="reactor")


REACTOR = (
    _reactor("the greater is the lesser", "return b < a ? b : a;", "return b > a ? b : a;"),
    _reactor("low ends combine to the least", "b->low = greater(", "b->low = lesser("),
    _reactor("a released limit closes in", "bounding[i].high + gone", "bounding[i].high - gone"),
    _reactor("a ramp of milliseconds", "(t_ns - since_ns) / 1e9", "(t_ns - since_ns) / 1e6"),
    _reactor(
        "a limit fades while it is in force",
        "if (r->state[task] == HOLDING)\n        return 0.0;",
        "",
    ),
    _reactor("a limit of another action", "{0, 0, (-0.2), 0.4, 0.3}", "{0, 0, (-0.2), 0.5, 0.3}"),
    _reactor("factors multiply bounds", "value * b.factor, b.low", "value, b.low * b.factor"),
    _reactor("what is not finite passes", "isfinite(value) ?", "!isnan(value) ?"),
    _reactor("commands pass before all is known", "= r->opened && t_ns", "= t_ns"),
    _reactor(
        "the lower rule gets what both need",
        "/* parameter /planner.speed */ 1, 0,",
        "/* parameter /planner.speed */ 0, 1,",
    ),
    _reactor(
        "rules begin in the wrong order", "rule_order[10] = {1, 0,", "rule_order[10] = {0, 1,"
    ),
    _reactor("an overruled task is not given up", "            give_up(r, task);\n", ""),
    _reactor(
        "a waiting task never begins again",
        "(r->state[task] == WAITING || r->state[task] == OVERDUE) && overruler(r, task) < 0",
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
    _reactor("what waits in vain waits on", "WAITING && r->now_ns >= due(r, task)", "IDLE"),
    _reactor(
        "what waits has time from when it was overruled",
        "    if (r->state[task] != RUNNING)\n        r->since_ns",
        "    r->since_ns",
    ),
    _reactor(
        "what held before it waits has no more time",
        "    if (r->state[task] != RUNNING)\n        r->since_ns[task] = r->now_ns;\n",
        "",
    ),
    _reactor(
        "nothing but a confirmation answers", "tasks[other].answer == tasks[task].deed", "false"
    ),
    _reactor(
        "what is not done yet answers",
        "if (r->state[other] == HOLDING && tasks[other].answer",
        "if (tasks[other].answer",
    ),
    _reactor("a confirmation does not answer", "return is_confirmed(m, task);", "return false;"),
    _reactor(
        "what nobody awaits waits, whatever follows", "if (tasks[task].fails_at_once)", "if (false)"
    ),
    _reactor(
        "what is overdue never begins again",
        "(r->state[task] == WAITING || r->state[task] == OVERDUE)",
        "r->state[task] == WAITING",
    ),
    _reactor(
        "escalations begin twice",
        "        if (r->state[*task] != IDLE)\n            continue;\n",
        "",
    ),
    _reactor("the same message is overruled", "tasks[task].rule || is_shared", "tasks[task].rule"),
    _reactor("what is done is shared", "is_same && tasks[task].timeout_ns == 0", "is_same"),
    _reactor("what is answered for wakes for ever", "        if (due_ns > r->now_ns)\n", ""),
    _reactor("an unknown confirmation will do", "== NAMED(TRUE)", "!= NAMED(FALSE)"),
    _reactor("a report is remembered from the last time", "    r->reported[task] = false;\n", ""),
    _reactor(
        "what started first is stopped first",
        "r->started[rule_tasks[rule] + i - 1];",
        "r->started[rule_tasks[rule] + r->started_count[rule] - i];",
    ),
    _reactor("a release undoes nothing", "            decide(r, task, NAMED(STOP), -1);\n", ""),
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
    _reactor("the oldest pose comes first", "i) % memories[k]", "0) % memories[k]"),
    _reactor("poses are recorded on the way back", "if (is_used || ", "if ("),
    _reactor("poses that are not known are recorded", "!r->poses_known[k] || !is_new", "!is_new"),
    _reactor(
        "the robot is sent while nobody knows where it is",
        "r->poses_kept[k] == 0 || !r->poses_known[k]",
        "r->poses_kept[k] == 0",
    ),
    _reactor(
        "a distance along one axis", "const double y = pose[1] - last[1];", "const double y = 0.0;"
    ),
    _reactor("the time between poses is not kept", ">= memories[k].pose_gap_ns", ">= 0"),
    _reactor(
        "a full memory takes nothing more", "r->poses_kept[k]--;\n        }", "continue;\n        }"
    ),
    _reactor("a period is over at once", "+ retraces[i].pose_period_ns", ""),
    _reactor(
        "a task that starts again waits",
        "            r->pose_sent_ns[i] = NEVER;\n}",
        "            (void)i;\n}",
    ),
    _reactor("a jump back forgets when a pose was sent", "pose_set_back(r, t_ns);", ";"),
    _reactor("poses wake nobody", "wake_ns = pose_wake(r, wake_ns);", ""),
)
