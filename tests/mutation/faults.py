"""Faults of a monitor: what a generator that errs might have written for `rules.ross`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Fault:
    """A change of the generated C at one place."""

    name: str
    old: str
    new: str
    part: Literal["monitor", "reactor"] = "monitor"


@dataclass(frozen=True)
class Equivalent:
    """A change that nobody can notice, and why."""

    fault: Fault
    reason: str


_LIMITS = (
    Fault(
        "a limit that is reached counts as passed, inside a guard",
        "!UNLIKELY(!(x > m->low[g]))",
        "!UNLIKELY(!(x >= m->low[g]))",
    ),
    Fault(
        "a limit that is reached counts as passed, when a number becomes known",
        "guard_limits[g + 1] && x > limits[place + 1].at; place++",
        "guard_limits[g + 1] && x >= limits[place + 1].at; place++",
    ),
    Fault(
        "a limit that is reached counts as passed, when a number falls far",
        "place != guard_limits[g] && x <= limits[place]",
        "place != guard_limits[g] && x < limits[place]",
    ),
    Fault("a limit of another number", "{1.0, PROPOSITION_SPEED_IN", "{1.5, PROPOSITION_SPEED_IN"),
    Fault("`<` is taken for `<=`", "{0.39999999999999997, ", "{0.4, "),
    Fault(
        "a comparison is turned round below its limit",
        "leaf_below[18] = {\n    FALSE, FALSE, FALSE, FALSE, FALSE, TRUE,",
        "leaf_below[18] = {\n    FALSE, FALSE, FALSE, FALSE, FALSE, FALSE,",
    ),
    Fault(
        "both ends of an interval are crossed and the proposition flips once",
        "PROPOSITION_SPEED_IN_0_5_1_M_S, TRUE, 1}",
        "PROPOSITION_SPEED_IN_0_5_1_M_S, TRUE, 0}",
    ),
    Fault(
        "a crossed limit sets the opposite",
        "limits[crossed].above ^ is_rising ^ 1u",
        "limits[crossed].above ^ is_rising",
    ),
    Fault("a guard is open above", "m->high[g] = limits[place + 1].at;", "m->high[g] = DBL_MAX;"),
    Fault("degrees are taken for radians", "= data * 0.017453292519943295 + 0.0;", "= data;"),
)

_DURATIONS = (
    Fault(
        "a duration is over an instant late",
        "t_ns >= due_ns ? (unsigned char)TRUE",
        "t_ns > due_ns ? (unsigned char)TRUE",
    ),
    Fault(
        "a duration of another condition",
        "INT64_C(1000000000), /* rules.ross:60",
        "INT64_C(1100000000), /* rules.ross:60",
    ),
    Fault("a duration is not begun anew", "operand == TRUE ? due_ns : NEVER", "due_ns"),
    Fault(
        "nothing is remembered of before a duration",
        "m->held_before[k] = operand == TRUE ? m->held_before[k] : operand;",
        "",
    ),
    Fault("nobody wakes for a duration", "    wake_by(m, m->held_due_ns[k]);\n", ""),
    Fault(
        "the next wake forgets durations",
        "        if (m->held_due_ns[k] > m->now_ns && m->truth_value[held_nodes[k]] != TRUE)\n"
        "            wake_ns = earlier(wake_ns, m->held_due_ns[k]);\n",
        "            ;\n",
    ),
    Fault(
        "a duration is over and nobody looks",
        "            mark(m, held_nodes[k]);",
        "            ;",
    ),
    Fault("since when a proposition holds is not noted", "    m->since_ns[node] = t_ns;\n", ""),
)

_TIME = (
    Fault(
        "a timer of the same instant runs before a message",
        "if (wake_ns >= t_ns)",
        "if (wake_ns > t_ns)",
    ),
    Fault(
        "a message at a due instant is taken as calm", "t_ns < m->wake_ns;", "t_ns <= m->wake_ns;"
    ),
    Fault(
        "time stands still where nothing arrives",
        "    tick(m, t_ns);\n#if GUARDS && BESIDE",
        "#if GUARDS && BESIDE",
    ),
    Fault(
        "what was before a duration survives a jump back",
        "m->held_before[k] = m->started ? UNKNOWN : FALSE;",
        ";",
    ),
    Fault(
        "samples survive a jump back",
        "    for (unsigned k = 0; k != SAMPLED; k++)\n        forget_samples(m, k);\n",
        "",
    ),
    Fault(
        "turning points survive a jump back",
        "        forget_turns(m, k);\n#endif",
        "        ;\n#endif",
    ),
    Fault(
        "messages are of the future after a jump back",
        "        m->stamp_ns[i] = t_ns - (age_ns < LONGEST ? age_ns : LONGEST);",
        "",
    ),
    Fault("a jump back is taken as progress", "if (t_ns < m->now_ns) {", "if (false) {"),
)

_INPUTS = (
    Fault(
        "an input expires an instant late",
        "t_ns - m->stamp_ns[i] >= input_timeouts[i]",
        "t_ns - m->stamp_ns[i] > input_timeouts[i]",
    ),
    Fault(
        "an expired input keeps its numbers",
        "        m->value[stale_values[i]] = NAN;",
        "        ;",
    ),
    Fault(
        "an expired input keeps its samples",
        "        forget_samples(m, stale_samples[i]);",
        "        ;",
    ),
    Fault(
        "nobody looks at numbers that expired",
        "    if (has_expired)\n        review(m, t_ns);\n",
        "",
    ),
    Fault(
        "an expired channel is still quiet",
        "    m->state[input] = EXPIRED;\n    m->quiet[input_channel[input]] = false;",
        "    m->state[input] = EXPIRED;",
    ),
    Fault(
        "a timeout of another input",
        "INT64_C(200000000), /* INPUT_ORIENTATION */",
        "INT64_C(500000000), /* INPUT_ORIENTATION */",
    ),
    Fault(
        "a stale input is merely unknown",
        "            return STALE;\n    if (row_blames",
        "            return UNKNOWN;\n    if (row_blames",
    ),
    Fault(
        "an age is reached an instant late",
        "value = t_ns >= due_ns ? TRUE : FALSE;",
        "value = t_ns > due_ns ? TRUE : FALSE;",
    ),
    Fault(
        "an age that nobody knows is reached", "age_unknown[1] = {STALE}", "age_unknown[1] = {TRUE}"
    ),
    Fault(
        "an age of a message that arrived is forgotten",
        "    set_truth_value(m, age_leaf[k], value, t_ns);",
        "",
    ),
)

_CONDITIONS = (
    Fault(
        "`and` is false only if both are",
        "if (a == FALSE || b == FALSE)",
        "if (a == FALSE && b == FALSE)",
    ),
    Fault(
        "`or` is true only if both are",
        "if (a == TRUE || b == TRUE)",
        "if (a == TRUE && b == TRUE)",
    ),
    Fault(
        "`not` makes the unknown false",
        "return a == TRUE ? (unsigned char)FALSE : a;",
        "return FALSE;",
    ),
    Fault(
        "`and` of the wrong operand",
        "both(m->truth_value[PROPOSITION_AGE_FIX_2_5_SEC], ",
        "both(TRUE, ",
    ),
    Fault("who depends on a proposition is not marked", "    m->dirty |= node_users[node];\n", ""),
    Fault(
        "one who depends on a proposition is not marked",
        "BIT(PROPOSITION_NOT_SPEED_NOT_IN_0_5_1_M_S) | BIT(RULE_FAST)",
        "BIT(RULE_FAST)",
    ),
    Fault("marks are cleared together", "m->dirty &= m->dirty - 1;", "m->dirty = 0;"),
)

_RULES = (
    Fault("a stale condition does not activate", "condition == STALE", "condition == UNKNOWN"),
    Fault(
        "an unknown condition activates",
        "if (!was_active && condition == TRUE)",
        "if (!was_active && condition != FALSE)",
    ),
    Fault(
        "two rules are swapped",
        "m->truth_value[rule_condition[rule]];",
        "m->truth_value[rule_condition[rule < 2 ? 1 - rule : rule]];",
    ),
    Fault(
        "a rule clears without its release",
        "        m->truth_value[rule_release[rule]] == TRUE)",
        "        m->truth_value[rule_release[rule]] != UNSET)",
    ),
    Fault(
        "a rule clears while its condition is unknown",
        "if (was_active && condition == FALSE && rule_release",
        "if (was_active && condition != TRUE && rule_release",
    ),
    Fault(
        "a latched rule clears by itself",
        "PROPOSITION_NOT_SPEED_NOT_IN_0_5_1_M_S_FOR_1_SEC, LATCHED",
        "PROPOSITION_NOT_SPEED_NOT_IN_0_5_1_M_S_FOR_1_SEC, PROPOSITION_TRUE_",
    ),
    Fault(
        "a reset clears whatever the condition",
        "            m->truth_value[rule_condition[i]] == FALSE)",
        "            m->truth_value[rule_condition[i]] != UNSET)",
    ),
    Fault("a reset clears another rule", "(unsigned)rule == i", "(unsigned)rule == i + 1"),
    Fault(
        "a verdict tells another number",
        "/* fast */ VALUE_SPEED,",
        "/* fast */ VALUE_SLOPE,",
    ),
)

_NUMBERS = (
    Fault("infinity counts as known", "return x - (x - x);", "return x;"),
    Fault(
        "a missing element is no minimum's matter",
        "isnan(a) || isnan(b) ? NAN : a < b",
        "isnan(b) ? NAN : a < b",
    ),
    Fault(
        "a maximum for a minimum",
        "NAN : a < b ? a : b;",
        "NAN : a > b ? a : b;",
    ),
    Fault(
        "all of no elements is true",
        "? 0.0 : unknowns != 0 || count == 0 ? NAN : 1.0",
        "? 0.0 : unknowns != 0 ? NAN : 1.0",
    ),
    Fault("any needs two", "return trues != 0 ? 1.0", "return propositions > 1 ? 1.0"),
    Fault("the others are counted", "NAN : (double)trues", "NAN : (double)(count - propositions)"),
    Fault(
        "an unknown element counts as false",
        "return is_unknown ? UNKNOWN : value ? TRUE : FALSE",
        "return !is_unknown && value ? TRUE : FALSE",
    ),
    Fault("a pitch is turned round", "w * y - z * x", "z * x - w * y"),
    Fault("a sine beyond 1 by rounding", "1.0 < sine ? 1.0 : sine", "sine"),
    Fault("a rate over samples of one instant", "if (m->latest_ns[k] != t_ns) {", "{"),
    Fault("a rate in milliseconds", "m->before_ns[k]) / 1e9", "m->before_ns[k]) / 1e6"),
    Fault("no absolute value", "fabs(m->value[VALUE_SPEED]);", "m->value[VALUE_SPEED];"),
)

_OSCILLATION = (
    Fault(
        "a turning point counts an instant too long",
        "&& t_ns < recent_end(m, k)",
        "&& t_ns <= recent_end(m, k)",
    ),
    Fault(
        "two turning points are three",
        "return m->recent_count[k] == recent_first[k + 1] - recent_first[k]",
        "return m->recent_count[k] + 1 >= recent_first[k + 1] - recent_first[k]",
    ),
    Fault("a swing that is reached counts", "x > extreme + swing", "x >= extreme + swing"),
    Fault(
        "the extreme is not followed",
        "if (isnan(extreme) || (heading > 0 && x > extreme) ||",
        "if (isnan(extreme) ||",
    ),
    Fault(
        "turning points are kept through a gap",
        "        forget_turns(m, k);\n        return unknown_kind",
        "        return unknown_kind",
    ),
    Fault(
        "a gap ends an instant late",
        "m->gap_end_ns[k] >= recent_windows[k]",
        "m->gap_end_ns[k] > recent_windows[k]",
    ),
    Fault("a gap is never reported", "        m->gap[k] = source;", ""),
)

_EDGES = (
    Fault("what was unknown before has an edge", "&& before == FALSE", "&& before != TRUE"),
    Fault("an edge is never over", "    m->edge_before[k] = operand;\n", ""),
    Fault(
        "a jump is taken for the start",
        "m->edge_before[k] = m->started ? UNKNOWN",
        "m->edge_before[k] = m->started ? FALSE",
    ),
    Fault(
        "edges fall out of the window late", "recent_due(m, k) <= t_ns", "recent_due(m, k) < t_ns"
    ),
    Fault("nobody wakes for an edge", "        wake_by(m, recent_end(m, place));\n", "        ;\n"),
    Fault(
        "edges are kept over a jump",
        "        forget_recent(m, k);\n        m->gap",
        "        m->gap",
    ),
)

_FILTERS = (
    Fault(
        "a window is added from the end",
        "window_place(m, k, i)];\n        total",
        "window_place(m, k, m->window_count[k] - 1 - i)];\n        total",
    ),
    Fault(
        "a filter does not feed back",
        "    sample(m, 1, m->value[VALUE_LOW_PASS_SPEED_0_3_SEC], t_ns);\n",
        "",
    ),
)

MONITOR = (
    *_EDGES,
    *_FILTERS,
    *_LIMITS,
    *_DURATIONS,
    *_TIME,
    *_INPUTS,
    *_CONDITIONS,
    *_RULES,
    *_NUMBERS,
    *_OSCILLATION,
)


EQUIVALENT = (
    Equivalent(
        Fault("a guard keeps its upper end", "    m->high[g] = limits[place + 1].at;", ""),
        "what is not inside a guard is compared with all limits",
    ),
    Equivalent(
        Fault("ends of durations survive a jump back", "        m->held_due_ns[k] = NEVER;\n", ""),
        "each duration is evaluated before anybody asks, and sets its end",
    ),
    Equivalent(
        Fault("nothing is marked after a jump back", "        mark(m, node);", "        ;"),
        "every proposition was forgotten, and marks what rests on it when it is known again",
    ),
    Equivalent(
        Fault(
            "a timer that is due at the next wake moves it",
            "    if (due_ns < m->wake_ns)",
            "    if (due_ns <= m->wake_ns)",
        ),
        "the wake is set to what it is",
    ),
    Equivalent(
        Fault(
            "a minimum asks whether its first operand is missing",
            "isnan(a) || isnan(b) ? NAN : a < b",
            "isnan(a) ? NAN : a < b",
        ),
        "a comparison with a missing operand is false, and gives the second",
    ),
    Equivalent(
        Fault(
            "unknown elements are counted",
            "NAN : (double)trues",
            "NAN : (double)(trues + unknowns)",
        ),
        "there are none here: their number was compared with zero before",
    ),
)
