"""The sizes, the names and the constant tables of a monitor.

The input is a layout; the result is C text. Every entry that stands for a user's text contains the
text as a comment.
"""

from __future__ import annotations

from collections.abc import Sequence

from rossmarie import ir
from rossmarie.core import MOST_SAMPLES
from rossmarie.targets import comments
from rossmarie.targets.c99 import names
from rossmarie.targets.c99.coverage import covered_values
from rossmarie.targets.c99.layout import CLayout, ValueGuard
from rossmarie.targets.c99.recent import recent_tables
from rossmarie.targets.c99.state import is_small
from rossmarie.targets.c99.text import boolean, enumeration, lists, remarked_table, sizes, table
from rossmarie.targets.c99.types import duration, number
from rossmarie.targets.limits import true_below, twins


def tables(layout: CLayout) -> str:
    """All data of a machine for the engine."""
    parts = [
        sizes(_sizes(layout)),
        _value_names_listed(layout),
        _input_tables(layout),
        _proposition_names_listed(layout),
        _node_tables(layout),
        _guard_tables(layout) if layout.guards else "",
        _blame_tables(layout) if layout.guards or layout.oscillations else "",
        _timer_tables(layout),
        _sample_tables(layout),
        _rule_tables(layout),
    ]
    return "\n".join(part for part in parts if part)


def _sizes(layout: CLayout) -> dict[str, int]:
    """The sizes of the parts of a monitor. A part without an entry has size 0."""
    machine = layout.machine
    always = {
        "INPUTS": len(machine.inputs),
        "CHANNELS": len(machine.channels),
        "VALUES": len(layout.values),
        "LEAVES": layout.leaf_count,
        "PROPOSITIONS": layout.proposition_count,
        "RULES": len(machine.rules),
        "NODES": layout.proposition_count + len(machine.rules),
    }
    used = {
        "TIMEOUTS": sum(1 for used in machine.inputs if used.timeout_ns is not None),
        "GUARDS": len(layout.guards),
        "COVERED": len(covered_values(layout)),
        "EXCUSES": sum(map(len, _excuses(layout))),
        "LITERALS": len(layout.literals),
        "HELD": len(layout.held),
        "HELD_INITIALLY": sum(layout.held_initially),
        "SINCES": len(layout.sinces),
        "AGES": len(layout.ages),
        "OSCILLATIONS": len(layout.oscillations),
        "EDGES": len(layout.recurring),
        "RECENT": len(layout.recent),
        "SAMPLED": len(layout.sampled),
        "SAMPLED_VALUES": len(_sampled_values(layout)),
        "WINDOWS": len(layout.windows),
        "MOST_SAMPLES": MOST_SAMPLES if layout.windows else 0,
        "LISTS": len(machine.lists),
        "BESIDE": len(ir.beside(machine)),
        "READINGS": len(machine.readings),
        "WATCHES": len(machine.watches),
    }
    return {**always, **{name: size for name, size in used.items() if size}}


def _section(title: str, parts: Sequence[str]) -> str:
    """Parts under a title; empty if there are no parts."""
    found = [part.rstrip() for part in parts if part]
    return "\n".join([f"/* {title} */", *found, ""]) if found else ""


# --- inputs ----------------------------------------------------------------------------------


def _input_tables(layout: CLayout) -> str:
    """The names of inputs, the time in ns for which each input is fresh (0: always), and the values
    that expire with each input.
    """
    machine = layout.machine
    if not machine.inputs:
        return ""
    remarks = [
        f"{names.place(used.span)}  {machine.channels[used.channel].topic}"
        for used in machine.inputs
    ]
    timeouts = [duration(used.timeout_ns or 0) for used in machine.inputs]
    parts = [
        enumeration(list(zip(layout.input_names, remarks, strict=True))),
        table("index_t", "input_channel", [used.channel for used in machine.inputs]),
        remarked_table(
            "int64_t", "input_timeouts", list(zip(timeouts, layout.input_names, strict=True))
        ),
    ]
    if any(used.timeout_ns is not None for used in machine.inputs):
        parts += _expiry_tables(layout)
    return _section("Inputs: channels, timeouts in ns (0: none), values that expire.", parts)


def _expiry_tables(layout: CLayout) -> list[str]:
    values: list[Sequence[object]] = []
    samples: list[Sequence[object]] = []
    windows: list[Sequence[object]] = []
    for used in range(len(layout.machine.inputs)):
        stale = layout.has_timeout(used)
        values.append(
            [value.name for value in layout.values if stale and used in value.support.inputs]
        )
        samples.append(_resting(layout, layout.sampled, used))
        windows.append(_resting(layout, [window.signal for window in layout.windows], used))
    listed = [lists("input_values", "stale_values", _of_inputs(layout, values))]
    if layout.sampled:
        listed.append(lists("input_samples", "stale_samples", _of_inputs(layout, samples)))
    if layout.windows:
        listed.append(lists("input_windows", "stale_windows", _of_inputs(layout, windows)))
    return listed


def _of_inputs(layout: CLayout, rows: list[Sequence[object]]) -> list[tuple[str, Sequence[object]]]:
    return list(zip(layout.input_names, rows, strict=True))


def _resting(layout: CLayout, signals: Sequence[int], used: int) -> list[int]:
    """The places of the signals that depend on an input that expires."""
    if not layout.has_timeout(used):
        return []
    supports = layout.supports.signals
    return [place for place, signal in enumerate(signals) if used in supports[signal].inputs]


# --- propositions
# ----------------------------------------------------------------------------------


def _value_names_listed(layout: CLayout) -> str:
    rows = [(value.name, value.remark) for value in layout.values]
    return _section("Values: the stored numbers, in SI units.", [enumeration(rows)])


def _proposition_names_listed(layout: CLayout) -> str:
    propositions = [
        (layout.proposition_names[index], layout.remark(index))
        for index in layout.propositions_in_order()
    ]
    rules = [
        (_rule_node(layout, index), f"{names.place(rule.span)}  {rule.name}")
        for index, rule in enumerate(layout.machine.rules)
    ]
    title = "Nodes: propositions about values or ages, combined propositions, and rules."
    return _section(title, [enumeration([*propositions, *rules])])


def _rule_node(layout: CLayout, rule: int) -> str:
    return layout.rule_names[rule].upper()


def _node_tables(layout: CLayout) -> str:
    """The nodes that depend on each proposition, rules included."""
    users: list[set[int]] = [set() for _ in range(layout.proposition_count)]
    for index in layout.derived:
        for operand in ir.proposition_operands(layout.machine.propositions[index].node):
            users[layout.node_of_proposition[operand]].add(layout.node_of_proposition[index])
    for number_, rule in enumerate(layout.machine.rules):
        users[layout.node_of_proposition[rule.condition]].add(layout.proposition_count + number_)
        if rule.release is not None:
            users[layout.node_of_proposition[rule.release]].add(layout.proposition_count + number_)
    nodes = [layout.proposition_names[index] for index in layout.propositions_in_order()]
    nodes += [_rule_node(layout, rule) for rule in range(len(layout.machine.rules))]
    found = [[nodes[user] for user in sorted(each)] for each in users]
    named = list(zip(nodes[: layout.proposition_count], found, strict=True))
    title = "The nodes that depend on each proposition."
    if not is_small(layout):
        return _section(title, [lists("node_users", "users", named)])
    rows = [(" | ".join(f"BIT({user})" for user in row) or "NOBODY", name) for name, row in named]
    return _section(title, [remarked_table("uint64_t", "node_users", rows)])


def _rule_tables(layout: CLayout) -> str:
    rules = layout.machine.rules
    remarks = [f"{names.place(rule.span)}  {rule.name}: {rule.contract}" for rule in rules]
    conditions = [layout.proposition_names[rule.condition] for rule in rules]
    releases = [
        "LATCHED" if rule.release is None else layout.proposition_names[rule.release]
        for rule in rules
    ]
    terms = [[layout.proposition_names[term] for term in rule.terms] for rule in rules]
    values = [
        [layout.values[layout.value_of_signal[signal]].name for signal in rule.signals]
        for rule in rules
    ]
    inputs = [[layout.input_names[used] for used in rule.inputs] for rule in rules]
    read = [
        layout.values[layout.value_of_signal[signal]].name for signal in layout.machine.readings
    ]
    watched = [layout.proposition_names[proposition] for proposition in layout.machine.watches]
    return _section(
        "Rules: the condition, the condition for clearing, and the content of the verdicts.",
        [
            remarked_table(
                "index_t", "rule_condition", list(zip(conditions, remarks, strict=True))
            ),
            table("index_t", "rule_release", releases),
            lists("rule_terms", "terms", _of_rules(layout, terms)),
            lists("rule_values", "shown_values", _of_rules(layout, values)),
            lists("rule_inputs", "shown_inputs", _of_rules(layout, inputs)),
            table("index_t", "watched_propositions", watched) if watched else "",
            table("index_t", "watched_values", read) if read else "",
        ],
    )


def _of_rules(layout: CLayout, rows: list[list[str]]) -> list[tuple[str, list[str]]]:
    return list(zip([rule.name for rule in layout.machine.rules], rows, strict=True))


# --- guards ----------------------------------------------------------------------------------


def _guard_tables(layout: CLayout) -> str:
    leaves, starts, below = [0], [0], []
    rows: list[str] = []
    for guard in layout.guards:
        rows += _limit_rows(layout, guard)
        leaves.append(leaves[-1] + len(guard.leaves))
        starts.append(len(rows))
        holds = true_below(guard.limits)
        below += ["TRUE" if leaf in holds else "FALSE" for leaf in guard.leaves]
    named = [(guard.name, layout.values[guard.value].remark) for guard in layout.guards]
    values = [layout.values[guard.value].name for guard in layout.guards]
    covered = [layout.values[value].name for value in sorted(covered_values(layout))]
    listed = "\n".join(f"    {row}" for row in rows)
    watching = [
        (name, [guard.name for guard in layout.guards_of(channel)])
        for channel, name in enumerate(layout.channel_names)
    ]
    return _section(
        "Guards: the watched values, and their limits from low to high.",
        [
            enumeration(named),
            table("index_t", "guard_value", values),
            table("index_t", "covered_values", covered) if covered else "",
            lists("channel_guards", "watching", watching),
            table("index_t", "guard_leaves", leaves),
            table("index_t", "guard_limits", starts),
            f"static const limit limits[{len(rows)}] = {{\n{listed}\n}};",
            table("unsigned char", "leaf_below", below),
        ],
    )


def _limit_rows(layout: CLayout, guard: ValueGuard) -> list[str]:
    """The limits of a guard between two ends."""
    rows = [f"BELOW_ALL, /* {comments.in_c(layout.values[guard.value].remark)} */"]
    pairs = enumerate(zip(guard.limits, twins(guard.limits), strict=True))
    for place, (limit, other) in pairs:
        above = "TRUE" if limit.rises else "FALSE"
        away = 0 if other is None else other - place
        leaf = layout.proposition_names[limit.leaf]
        remark = comments.in_c(layout.remark(limit.leaf))
        rows.append(f"{{{number(limit.at)}, {leaf}, {above}, {away}}}, /* {remark} */")
    return [*rows, "ABOVE_ALL,"]


def _blame_tables(layout: CLayout) -> str:
    """The values that make a guard stale if they are missing, and the values that make it unknown;
    then the same for oscillations.
    """
    swings = [layout.supports.propositions[index] for index in layout.oscillations]
    blames = [layout.guard_blames(guard) for guard in layout.guards]
    blames += [layout.blamed(support) for support in swings]
    listed = [lists("row_blames", "blames", _rows_of_values(layout, blames))]
    excuses = _excuses(layout)
    if not any(excuses):
        return _section("Missing values that make a proposition stale.", listed)
    of_lists = [boolean(layout.is_of_list(value)) for row in excuses for value in row]
    return _section(
        "Missing values that make a proposition stale, and those that make it unknown.",
        [
            *listed,
            lists("row_excuses", "excuses", _rows_of_values(layout, excuses)),
            table("bool", "is_of_list", of_lists) if layout.machine.lists else "",
        ],
    )


def _excuses(layout: CLayout) -> list[list[int]]:
    """The values that make each guard, and then each oscillation, unknown if they are missing."""
    supports = [layout.values[guard.value].support for guard in layout.guards]
    supports += [layout.supports.propositions[index] for index in layout.oscillations]
    return [layout.excuses(support) for support in supports]


def _rows_of_values(layout: CLayout, rows: list[list[int]]) -> list[tuple[str, list[str]]]:
    owners = [guard.name for guard in layout.guards]
    owners += [layout.proposition_names[index] for index in layout.oscillations]
    found = [[layout.values[value].name for value in row] for row in rows]
    return list(zip(owners, found, strict=True))


# --- timers and samples ----------------------------------------------------------------------


def _timer_tables(layout: CLayout) -> str:
    parts = [
        *(_held_tables(layout) if layout.held else ()),
        *(_age_tables(layout) if layout.ages else ()),
        *(recent_tables(layout) if layout.recent else ()),
        *(_literal_tables(layout) if layout.literals else ()),
    ]
    edges = " edges," if layout.recurring else ""
    title = f"Durations, ages, turning points,{edges} and propositions that never change."
    return _section(title, parts)


def _literal_tables(layout: CLayout) -> list[str]:
    propositions = layout.machine.propositions
    values = [_value(propositions[index].node == ir.Literal(True)) for index in layout.literals]
    named = [layout.proposition_names[index] for index in layout.literals]
    return [
        table("index_t", "literals", named),
        table("unsigned char", "literal_values", values),
    ]


def _value(holds: bool) -> str:
    return "TRUE" if holds else "FALSE"


def _sample_tables(layout: CLayout) -> str:
    if not layout.sampled and not layout.windows:
        return ""
    parts = [table("index_t", "sampled_values", _sampled_values(layout))]
    if layout.windows:
        lengths = [duration(window.length_ns) for window in layout.windows]
        parts.append(table("int64_t", "window_lengths", lengths))
    return _section("Values that depend on samples.", parts)


def _sampled_values(layout: CLayout) -> list[str]:
    """The values that depend on samples, which a jump in time deletes."""
    rests: set[int] = set()
    for index, signal in enumerate(layout.machine.signals):
        operands = ir.signal_operands(signal.node)
        if isinstance(signal.node, ir.Sampled) or rests.intersection(operands):
            rests.add(index)
    return [
        value.name for value in layout.values if _rests_on(layout, value.signal, value.test, rests)
    ]


def _rests_on(layout: CLayout, signal: int | None, test: int | None, rests: set[int]) -> bool:
    if test is not None:
        compared = ir.compared_signals(layout.machine.propositions[test].node)
        return bool(rests.intersection(compared))
    return signal in rests


def _held_tables(layout: CLayout) -> list[str]:
    rows = []
    for index in layout.held:
        node = layout.machine.propositions[index].node
        assert isinstance(node, ir.Held), "the layout lists durations"
        rows.append((duration(node.duration_ns), layout.remark(index)))
    nodes = [layout.proposition_names[index] for index in layout.held]
    initially = layout.held_initially
    values = [_value(holds) for holds in initially]
    return [
        remarked_table("int64_t", "held_durations", rows),
        table("index_t", "held_nodes", nodes),
        table("unsigned char", "held_initially", values) if any(initially) else "",
    ]


def _age_tables(layout: CLayout) -> list[str]:
    limits, inputs, unknown = [], [], []
    for index in layout.ages:
        node = layout.machine.propositions[index].node
        assert isinstance(node, ir.AgeReaches), "the layout lists ages"
        limits.append((duration(node.age_ns), layout.remark(index)))
        inputs.append(layout.input_names[node.input])
        unknown.append("STALE" if layout.has_timeout(node.input) else "UNKNOWN")
    leaves = [layout.proposition_names[index] for index in layout.ages]
    return [
        remarked_table("int64_t", "age_limits", limits),
        table("index_t", "age_input", inputs),
        table("unsigned char", "age_unknown", unknown),
        table("index_t", "age_leaf", leaves),
    ]
