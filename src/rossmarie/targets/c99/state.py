"""What a monitor remembers, and what time does to it: the members of its struct, and the lines
that begin, restart, tick and look for the next timer. A machine pays only for what it uses.
"""

from __future__ import annotations

from rossmarie import ir
from rossmarie.core import MOST_SAMPLES
from rossmarie.targets.c99.coverage import covered_values
from rossmarie.targets.c99.layout import Layout
from rossmarie.targets.c99.text import indented


def has_timeouts(layout: Layout) -> bool:
    """Whether any input expires."""
    return any(used.timeout_ns is not None for used in layout.machine.inputs)


def is_small(layout: Layout) -> bool:
    """Whether the marks of all truths and rules fit one word."""
    return layout.truth_count + len(layout.machine.rules) <= 64


def parts(layout: Layout) -> set[str]:
    """The C functions that the state needs."""
    found = {
        "guards": layout.guards,
        "unknown_kind": layout.guards or layout.oscillations,
        "covered": covered_values(layout),
        "as_is": layout.guards and not covered_values(layout),
        "held": layout.held,
        "oscillations": layout.oscillations,
        "follow": layout.oscillations,
        "ages": layout.ages,
        "samples": layout.sampled,
        "windows": layout.windows,
        "earlier": has_timeouts(layout) or layout.held or layout.oscillations or layout.ages,
        "wake_by": layout.held or layout.oscillations or layout.ages,
    }
    return {name for name, needed in found.items() if needed}


def turns(layout: Layout) -> list[int]:
    """How many turning points each oscillation remembers."""
    nodes = [layout.machine.truths[index].node for index in layout.oscillations]
    return [node.count for node in nodes if isinstance(node, ir.Oscillates)]


def members(layout: Layout) -> list[str]:
    """The members of the struct of a monitor; those that every message looks at come first."""
    machine, truths = layout.machine, layout.truth_count
    words = (truths + len(machine.rules) + 63) // 64
    found = [
        "int64_t now_ns;",
        "int64_t wake_ns;",
        f"double value[{max(1, len(layout.values))}];",
    ]
    if layout.guards:
        found += [f"double low[{len(layout.guards)}];", f"double high[{len(layout.guards)}];"]
    found += [
        "uint64_t dirty;" if is_small(layout) else f"uint64_t dirty[{words}];",
        f"bool quiet[{max(1, len(machine.channels))}];",
        "bool started;",
        *([] if is_small(layout) else ["bool pending;"]),
        f"int64_t stamp_ns[{max(1, len(machine.inputs))}];",
        f"unsigned char state[{max(1, len(machine.inputs))}];",
        f"unsigned char active[{(max(1, len(machine.rules)) + 7) // 8}];",
        f"unsigned char truth[{max(1, truths)}];",
        f"int64_t since_ns[{max(1, truths)}];",
    ]
    if layout.guards:
        found.append(f"int place[{len(layout.guards)}];")
    if layout.held:
        found.append(f"int64_t held_due_ns[{len(layout.held)}];")
        found.append(f"unsigned char held_before[{len(layout.held)}];")
    found += _sample_members(len(layout.sampled))
    found += [*_window_members(len(layout.windows)), *_turn_members(turns(layout))]
    return [*found, f"{layout.name}_callback on_event;", "void *user;"]


def _sample_members(count: int) -> list[str]:
    kinds = ("double latest", "double before", "int64_t latest_ns", "int64_t before_ns")
    return [f"{kind}[{count}];" for kind in kinds if count]


def _window_members(count: int) -> list[str]:
    if count == 0:
        return []
    return [
        f"double window_value[{count}][{MOST_SAMPLES}];",
        f"int64_t window_ns[{count}][{MOST_SAMPLES}];",
        f"uint16_t window_first[{count}];",
        f"uint16_t window_count[{count}];",
    ]


def _turn_members(counts: list[int]) -> list[str]:
    if not counts:
        return []
    return [
        f"double extreme[{len(counts)}];",
        f"int64_t turn_ns[{sum(counts)}];",
        f"uint16_t turns[{len(counts)}];",
        f"uint16_t turn_next[{len(counts)}];",
        f"signed char heading[{len(counts)}];",
        f"unsigned char swinging[{len(counts)}];",
        f"unsigned char gap[{len(counts)}];",
        f"int64_t gap_end_ns[{len(counts)}];",
    ]


def begin(layout: Layout) -> list[str]:
    """What `init` does beyond clearing the memory."""
    return [f"for (unsigned i = 0; i != {len(layout.values)}; i++)", "    m->value[i] = NAN;"]


def restart(layout: Layout) -> list[str]:
    """What is forgotten when time begins, or begins again (S17); inputs keep their ages."""
    lines = []
    if layout.machine.inputs:
        lines += [
            "for (unsigned i = 0; i != INPUTS; i++) {",
            "    const int64_t age_ns = m->now_ns - m->stamp_ns[i];",
            "    m->stamp_ns[i] = t_ns - (age_ns < LONGEST ? age_ns : LONGEST);",
            "}",
        ]
    if layout.channel_names:
        lines += ["for (unsigned i = 0; i != CHANNELS; i++)", "    m->quiet[i] = false;"]
    if layout.held:
        lines += [
            "for (unsigned k = 0; k != HELD; k++) {",
            "    m->held_due_ns[k] = NEVER;",
            "    m->held_before[k] = m->started ? UNKNOWN : FALSE;",
            "}",
        ]
    if layout.sampled:
        lines += ["for (unsigned k = 0; k != SAMPLED; k++)", "    forget_samples(m, k);"]
    if layout.windows:
        lines += ["for (unsigned k = 0; k != WINDOWS; k++)", "    forget_window(m, k);"]
    if layout.sampled or layout.windows:
        lines += ["for (unsigned i = 0; i != SAMPLED_VALUES; i++)"]
        lines += ["    m->value[sampled_values[i]] = NAN;"]
    if layout.oscillations:
        lines += [
            "for (unsigned k = 0; k != OSCILLATIONS; k++) {",
            "    forget_turns(m, k);",
            "    m->gap[k] = m->started ? UNKNOWN : FALSE;",
            "    m->gap_end_ns[k] = t_ns;",
            "}",
        ]
    for index in layout.literals:
        value = "TRUE" if layout.machine.truths[index].node == ir.Literal(True) else "FALSE"
        lines.append(f"set_truth(m, {layout.truth_names[index]}, {value}, t_ns);")
    if layout.guards:
        lines += [
            "for (unsigned g = 0; g != GUARDS; g++) {",
            "    m->place[g] = -(int)UNSET;",
            "    m->low[g] = INFINITY;",
            "    m->high[g] = -INFINITY;",
            "}",
            "review(m, t_ns);",
        ]
    return lines


def expire(layout: Layout) -> str:
    """The function that forgets what an input brought (S10, S21); nothing if none expires."""
    if not has_timeouts(layout):
        return ""
    lines = [
        "m->state[input] = EXPIRED;",
        "m->quiet[input_channel[input]] = false;",
        *_each_lost("input_values", "m->value[lost_values[i]] = NAN;"),
    ]
    if layout.sampled:
        lines += _each_lost("input_samples", "forget_samples(m, lost_samples[i]);")
    if layout.windows:
        lines += _each_lost("input_windows", "forget_window(m, lost_windows[i]);")
    return (
        "/* An input reached its timeout: what it brought is forgotten. */\n"
        f"static void expire(monitor *m, unsigned input)\n{{\n{indented(lines)}\n}}\n"
    )


def _each_lost(starts: str, does: str) -> list[str]:
    return [
        f"for (unsigned i = {starts}[input]; i != {starts}[input + 1]; i++)",
        f"    {does}",
    ]


def has_all_inputs(layout: Layout) -> list[str]:
    """The search for an input with a timeout that has never arrived."""
    if not has_timeouts(layout):
        return ["(void)m;"]
    return [
        "for (unsigned i = 0; i != INPUTS; i++)",
        "    if (m->state[i] == NEVER_RECEIVED && input_timeouts[i] != 0)",
        "        return false;",
    ]


def tick(layout: Layout) -> list[str]:
    """What is looked at when a timer may be due."""
    lines: list[str] = []
    if has_timeouts(layout):
        lines += [
            *(["bool has_expired = false;"] if layout.guards else []),
            "for (unsigned i = 0; i != INPUTS; i++) {",
            "    if (m->state[i] == FRESH && input_timeouts[i] != 0 &&",
            "        t_ns - m->stamp_ns[i] >= input_timeouts[i]) {",
            "        expire(m, i);",
            *(["        has_expired = true;"] if layout.guards else []),
            "    }",
            "}",
            *(["if (has_expired)", "    review(m, t_ns);"] if layout.guards else []),
        ]
    if layout.ages:
        lines += ["for (unsigned k = 0; k != AGES; k++)", "    look_at_age(m, k, t_ns);"]
    if layout.oscillations:
        lines += ["for (unsigned k = 0; k != OSCILLATIONS; k++)"]
        lines += ["    look_at_swings(m, k, t_ns);"]
    if layout.held:
        lines += [
            "for (unsigned k = 0; k != HELD; k++)",
            "    if (m->held_due_ns[k] <= t_ns && m->truth[held_nodes[k]] != TRUE)",
            "        mark(m, held_nodes[k]);",
        ]
    return lines or ["(void)m;", "(void)t_ns;"]


def wake(layout: Layout) -> list[str]:
    """The search for the earliest timer (S15)."""
    lines: list[str] = []
    if has_timeouts(layout):
        due = "m->stamp_ns[i] + input_timeouts[i]"
        lines += [
            "for (unsigned i = 0; i != INPUTS; i++)",
            "    if (m->state[i] == FRESH && input_timeouts[i] != 0)",
            *_earlier(due),
        ]
    if layout.ages:
        lines += [
            "for (unsigned k = 0; k != AGES; k++)",
            "    if (m->truth[age_leaf[k]] == FALSE)",
            *_earlier("m->stamp_ns[age_input[k]] + age_limits[k]"),
        ]
    if layout.oscillations:
        lines += [
            "for (unsigned k = 0; k != OSCILLATIONS; k++)",
            "    if (m->truth[turn_leaf[k]] == TRUE)",
            *_earlier("oldest_turn(m, k) + turn_windows[k]"),
            "    else if (m->truth[turn_leaf[k]] != FALSE && m->gap_end_ns[k] != NEVER)",
            *_earlier("m->gap_end_ns[k] + turn_windows[k]"),
        ]
    if layout.held:
        lines += [
            "for (unsigned k = 0; k != HELD; k++)",
            "    if (m->held_due_ns[k] > m->now_ns)",
            *_earlier("m->held_due_ns[k]"),
        ]
    return lines or ["(void)m;"]


def _earlier(due: str) -> list[str]:
    return indented([f"wake_ns = earlier(wake_ns, {due});"], 2).splitlines()
