"""The memory of a monitor: the members of its struct. A machine needs memory only for the features
that it uses.
"""

from __future__ import annotations

from rossmarie import ir
from rossmarie.core import MOST_SAMPLES
from rossmarie.targets.c99.layout import CLayout


def is_small(layout: CLayout) -> bool:
    """Say whether the marks of all propositions and rules fit one word."""
    return layout.proposition_count + len(layout.machine.rules) <= 64


def recent_counts(layout: CLayout) -> list[int]:
    """The number of turning points that each oscillation stores, followed by the number of edges
    that each count of edges stores.
    """
    nodes = [layout.machine.propositions[index].node for index in layout.recent]
    return [node.count for node in nodes if isinstance(node, ir.Oscillates | ir.Recurs)]


def members(layout: CLayout) -> list[str]:
    """The members of the struct of a monitor. Members that every message uses come first."""
    machine, propositions = layout.machine, layout.proposition_count
    words = (propositions + len(machine.rules) + 63) // 64
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
        f"unsigned char truth_value[{max(1, propositions)}];",
        f"int64_t since_ns[{max(1, propositions)}];",
    ]
    if layout.guards:
        found.append(f"int place[{len(layout.guards)}];")
    if layout.held:
        found.append(f"int64_t held_due_ns[{len(layout.held)}];")
        found.append(f"unsigned char held_before[{len(layout.held)}];")
    if layout.sinces:
        found.append(f"unsigned char since_before[{len(layout.sinces)}];")
    found += _sample_members(len(layout.sampled))
    found += [*_window_members(len(layout.windows)), *_turn_members(len(layout.oscillations))]
    if layout.recurring:
        found.append(f"unsigned char edge_before[{len(layout.recurring)}];")
    found += _recent_members(recent_counts(layout))
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


def _turn_members(count: int) -> list[str]:
    kinds = ("double extreme", "signed char heading", "unsigned char swinging")
    return [f"{kind}[{count}];" for kind in kinds if count]


def _recent_members(counts: list[int]) -> list[str]:
    if not counts:
        return []
    return [
        f"int64_t recent_ns[{sum(counts)}];",
        f"uint16_t recent_count[{len(counts)}];",
        f"uint16_t recent_next[{len(counts)}];",
        f"unsigned char gap[{len(counts)}];",
        f"int64_t gap_end_ns[{len(counts)}];",
    ]
