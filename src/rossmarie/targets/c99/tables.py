"""The constant tables and the enumerations of a monitor.

Takes a layout; gives C text. Every entry that a user's words stand behind carries them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rossmarie import ir
from rossmarie.core import MOST_SAMPLES
from rossmarie.targets.c99 import names
from rossmarie.targets.c99.coverage import covered_values
from rossmarie.targets.c99.layout import Guard, Layout
from rossmarie.targets.c99.state import has_timeouts, is_small, turns
from rossmarie.targets.c99.text import enumeration, lists, remarked_table, table
from rossmarie.targets.c99.types import duration, number
from rossmarie.targets.limits import true_below, twins

_CONSTANTS = """\
#define EARLIEST (-(INT64_C(1) << 60) * 2)
#define LATEST (INT64_C(1) << 62)
#define LONGEST (INT64_C(1) << 61)
#define NEVER INT64_MAX

enum { FALSE, TRUE, UNKNOWN, LOST, UNSET };
enum { NEVER_RECEIVED, FRESH, EXPIRED };
"""

_GUARD_REMARK = """\
/* Guards: guard g watches a value. It owns the truths from guard_leaves[g] up to, but without,
 * guard_leaves[g + 1], and the limits between the ends guard_limits[g] and guard_limits[g + 1] - 1,
 * from low to high. A number above limits[i] gives the truth limit_leaf[i] the value
 * limit_above[i]; limit_twin[i] is the other limit of the same truth, if it has two.
 */"""


def enumerations(layout: Layout) -> str:
    """Names for all indexes."""
    machine = layout.machine
    inputs = [
        (name, f"{names.place(used.span)}  {machine.channels[used.channel].topic}")
        for name, used in zip(layout.input_names, machine.inputs, strict=True)
    ]
    values = [(value.name, value.remark) for value in layout.values]
    guards = [(guard.name, layout.values[guard.value].remark) for guard in layout.guards]
    truths = [
        (layout.truth_names[index], _remark(layout, index)) for index in layout.truths_in_order()
    ]
    sizes = {
        "LEAVES": layout.leaf_count,
        "RULES": len(machine.rules),
        "CHANNELS": len(machine.channels),
        "HELD": len(layout.held),
        "AGES": len(layout.ages),
        "OSCILLATIONS": len(layout.oscillations),
        "SAMPLED": len(layout.sampled),
        "SAMPLED_VALUES": len(_sampled_values(layout)),
        "COVERED": len(covered_values(layout)),
        "LATCHED": 0xFFFF,
        "NO_TWIN": 0xFFFF,
    }
    if layout.windows:
        sizes |= {"WINDOWS": len(layout.windows), "MOST_SAMPLES": MOST_SAMPLES}
    if machine.watches:
        sizes["WATCHES"] = len(machine.watches)
    if not is_small(layout):
        sizes["WORDS"] = (layout.truth_count + len(machine.rules) + 63) // 64
    counts = "\n".join(f"    {name} = {size}," for name, size in sizes.items()).rstrip(",")
    return "\n".join(
        [
            _CONSTANTS,
            "/* Inputs. */",
            enumeration(inputs, "INPUTS"),
            "\n/* The numbers that a monitor keeps. */",
            enumeration(values, "VALUES"),
            "\n/* The numbers that are watched. */",
            enumeration(guards, "GUARDS"),
            "\n/* Truths: first those that look at numbers or ages, then those made of others. */",
            enumeration(truths, "TRUTHS"),
            f"\nenum {{\n{counts}\n}};\n",
        ]
    )


def tables(layout: Layout) -> str:
    """All tables that the machine needs."""
    parts = [_input_tables(layout), _node_tables(layout), _rule_tables(layout)]
    if layout.guards:
        parts.append(_guard_tables(layout))
    if layout.guards or layout.oscillations:
        parts.append(_blame_tables(layout))
    if has_timeouts(layout):
        parts.append(_expiry_tables(layout))
    if layout.held:
        parts.append(_held_tables(layout))
    if layout.ages:
        parts.append(_age_tables(layout))
    if layout.oscillations:
        parts.append(_turn_tables(layout))
    if layout.sampled or layout.windows:
        parts.append(table("index_t", "sampled_values", _sampled_values(layout)))
    if layout.windows:
        lengths = [duration(window.length_ns) for window in layout.windows]
        parts.append(table("int64_t", "window_lengths", lengths))
    if layout.machine.watches:
        watched = [layout.truth_names[truth] for truth in layout.machine.watches]
        parts.append(table("index_t", "watched_truths", watched))
    return "\n\n".join(parts) + "\n"


def _remark(layout: Layout, truth: int) -> str:
    declared = layout.machine.truths[truth]
    return f"{names.place(declared.span)}  {declared.text}"


# --- inputs ----------------------------------------------------------------------------------


def _input_tables(layout: Layout) -> str:
    inputs = layout.machine.inputs
    if not inputs:
        return ""
    parts = [table("index_t", "input_channel", [used.channel for used in inputs])]
    rows = [(duration(used.timeout_ns or 0), used.name) for used in inputs]
    return "\n".join([*parts, remarked_table("int64_t", "input_timeouts", rows)])


def _expiry_tables(layout: Layout) -> str:
    """What an input that expires takes with it."""
    values: list[list[str]] = []
    samples: list[list[int]] = []
    windows: list[list[int]] = []
    for used in range(len(layout.machine.inputs)):
        lost = layout.has_timeout(used)
        values.append(
            [value.name for value in layout.values if lost and used in value.support.inputs]
        )
        samples.append(_resting(layout, layout.sampled, used))
        windows.append(_resting(layout, [window.signal for window in layout.windows], used))
    parts = [lists("index_t", "input_values", "lost_values", values)]
    if layout.sampled:
        parts.append(lists("index_t", "input_samples", "lost_samples", samples))
    if layout.windows:
        parts.append(lists("index_t", "input_windows", "lost_windows", windows))
    return "\n".join(parts)


def _resting(layout: Layout, signals: Sequence[int], used: int) -> list[int]:
    """The places of those signals that rest on an input that expires."""
    if not layout.has_timeout(used):
        return []
    supports = layout.supports.signals
    return [place for place, signal in enumerate(signals) if used in supports[signal].inputs]


def _sampled_values(layout: Layout) -> list[str]:
    """The values that rest on samples, which a jump in time takes away."""
    rests: set[int] = set()
    for index, signal in enumerate(layout.machine.signals):
        operands = ir.signal_operands(signal.node)
        if isinstance(signal.node, ir.Sampled) or rests.intersection(operands):
            rests.add(index)
    return [
        value.name for value in layout.values if _rests_on(layout, value.signal, value.test, rests)
    ]


def _rests_on(layout: Layout, signal: int | None, test: int | None, rests: set[int]) -> bool:
    if test is not None:
        compared = ir.compared_signals(layout.machine.truths[test].node)
        return bool(rests.intersection(compared))
    return signal in rests


# --- truths ----------------------------------------------------------------------------------


def _node_tables(layout: Layout) -> str:
    """Which nodes depend on each truth, rules included."""
    users: list[set[int]] = [set() for _ in range(layout.truth_count)]
    for index in layout.derived:
        for operand in ir.truth_operands(layout.machine.truths[index].node):
            users[layout.node_of_truth[operand]].add(layout.node_of_truth[index])
    for number_, rule in enumerate(layout.machine.rules):
        users[layout.node_of_truth[rule.condition]].add(layout.truth_count + number_)
        if rule.release is not None:
            users[layout.node_of_truth[rule.release]].add(layout.truth_count + number_)
    remark = "/* What depends on each truth; rules stand behind all truths. */\n"
    if is_small(layout):
        masks = [f"UINT64_C({sum(1 << user for user in found):#x})" for found in users]
        return remark + table("uint64_t", "node_users", masks)
    return remark + lists("index_t", "node_users", "users", [sorted(found) for found in users])


def _rule_tables(layout: Layout) -> str:
    rules = layout.machine.rules
    remarks = [f"{names.place(rule.span)}  {rule.name}: {rule.contract}" for rule in rules]
    conditions = [layout.truth_names[rule.condition] for rule in rules]
    releases = [
        "LATCHED" if rule.release is None else layout.truth_names[rule.release] for rule in rules
    ]
    terms = [[layout.truth_names[term] for term in rule.terms] for rule in rules]
    values = [
        [layout.values[layout.value_of_signal[signal]].name for signal in rule.signals]
        for rule in rules
    ]
    inputs = [[layout.input_names[used] for used in rule.inputs] for rule in rules]
    return "\n".join(
        [
            "/* Rules: the condition, what must hold for them to clear, what a verdict carries. */",
            remarked_table(
                "index_t", "rule_condition", list(zip(conditions, remarks, strict=True))
            ),
            table("index_t", "rule_release", releases),
            lists("index_t", "rule_terms", "terms", terms),
            lists("index_t", "rule_values", "shown_values", values),
            lists("index_t", "rule_inputs", "shown_inputs", inputs),
        ]
    )


# --- guards ----------------------------------------------------------------------------------


def _guard_tables(layout: Layout) -> str:
    leaves, starts, below = [0], [0], []
    rows: list[_LimitRow] = []
    for guard in layout.guards:
        rows += _limit_rows(layout, guard, len(rows))
        leaves.append(leaves[-1] + len(guard.leaves))
        starts.append(len(rows))
        holds = true_below(guard.limits)
        below += ["TRUE" if leaf in holds else "FALSE" for leaf in guard.leaves]
    values = [layout.values[guard.value].name for guard in layout.guards]
    covered = [layout.values[value].name for value in sorted(covered_values(layout))]
    return "\n".join(
        [
            _GUARD_REMARK,
            table("index_t", "guard_value", values),
            *([table("index_t", "covered_values", covered)] if covered else []),
            table("index_t", "guard_leaves", leaves),
            table("index_t", "guard_limits", starts),
            remarked_table("double", "limits", [(row.at, row.remark) for row in rows]),
            table("index_t", "limit_leaf", [row.leaf for row in rows]),
            table("index_t", "limit_twin", [row.twin for row in rows]),
            table("unsigned char", "limit_above", [row.above for row in rows]),
            table("unsigned char", "leaf_below", below),
        ]
    )


@dataclass(frozen=True)
class _LimitRow:
    """An entry of the tables of limits; the default is one that is no limit but an end."""

    at: str
    remark: str
    leaf: str = "0"
    twin: str = "NO_TWIN"
    above: str = "FALSE"


def _limit_rows(layout: Layout, guard: Guard, start: int) -> list[_LimitRow]:
    """The limits of a guard between two ends."""
    name = layout.values[guard.value].name.removeprefix("VALUE_")
    rows = [_LimitRow("-INFINITY", f"below all limits of {name}")]
    for limit, other in zip(guard.limits, twins(guard.limits), strict=True):
        above = "TRUE" if limit.rises else "FALSE"
        twin = "NO_TWIN" if other is None else str(start + 1 + other)
        leaf = layout.truth_names[limit.leaf]
        rows.append(_LimitRow(number(limit.at), _remark(layout, limit.leaf), leaf, twin, above))
    return [*rows, _LimitRow("DBL_MAX", f"above all limits of {name}")]


def _blame_tables(layout: Layout) -> str:
    """The values whose lack makes a guard lost, and those whose lack leaves it unknown; then the
    same for the oscillations.
    """
    swings = [layout.supports.truths[index] for index in layout.oscillations]
    supports = [layout.values[guard.value].support for guard in layout.guards] + swings
    blames = [layout.guard_blames(guard) for guard in layout.guards]
    blames += [layout.blamed(support) for support in swings]
    excuses = [layout.excuses(support) for support in supports]
    return "\n".join(
        [
            "/* Whose lack makes a truth lost, and whose leaves it unknown. */",
            lists("index_t", "row_blames", "blames", _value_names(layout, blames)),
            lists("index_t", "row_excuses", "excuses", _value_names(layout, excuses)),
        ]
    )


def _value_names(layout: Layout, rows: list[list[int]]) -> list[list[str]]:
    return [[layout.values[value].name for value in row] for row in rows]


# --- timers ----------------------------------------------------------------------------------


def _held_tables(layout: Layout) -> str:
    rows = []
    for index in layout.held:
        node = layout.machine.truths[index].node
        assert isinstance(node, ir.Held), "the layout lists durations"
        rows.append((duration(node.duration_ns), _remark(layout, index)))
    nodes = [layout.truth_names[index] for index in layout.held]
    return "\n".join(
        [remarked_table("int64_t", "held_durations", rows), table("index_t", "held_nodes", nodes)]
    )


def _age_tables(layout: Layout) -> str:
    limits, inputs, unknown = [], [], []
    for index in layout.ages:
        node = layout.machine.truths[index].node
        assert isinstance(node, ir.AgeReaches), "the layout lists ages"
        limits.append((duration(node.age_ns), _remark(layout, index)))
        inputs.append(layout.input_names[node.input])
        unknown.append("LOST" if layout.has_timeout(node.input) else "UNKNOWN")
    leaves = [layout.truth_names[index] for index in layout.ages]
    return "\n".join(
        [
            remarked_table("int64_t", "age_limits", limits),
            table("index_t", "age_input", inputs),
            table("unsigned char", "age_unknown", unknown),
            table("index_t", "age_leaf", leaves),
        ]
    )


def _turn_tables(layout: Layout) -> str:
    windows, swings, values = [], [], []
    for index in layout.oscillations:
        node = layout.machine.truths[index].node
        assert isinstance(node, ir.Oscillates), "the layout lists oscillations"
        windows.append((duration(node.window_ns), _remark(layout, index)))
        swings.append(number(node.swing))
        values.append(layout.values[layout.value_of_signal[node.signal]].name)
    starts = [0]
    for count in turns(layout):
        starts.append(starts[-1] + count)
    leaves = [layout.truth_names[index] for index in layout.oscillations]
    return "\n".join(
        [
            remarked_table("int64_t", "turn_windows", windows),
            table("double", "turn_swings", swings),
            table("index_t", "turn_value", values),
            table("index_t", "turn_first", starts),
            table("index_t", "turn_leaf", leaves),
        ]
    )
