"""The constant tables of what is counted within a window: turning points, and edges.

Takes a layout; gives C text.
"""

from __future__ import annotations

from rossmarie import ir
from rossmarie.targets.c99 import names
from rossmarie.targets.c99.layout import Layout
from rossmarie.targets.c99.state import recent_counts
from rossmarie.targets.c99.text import remarked_table, table
from rossmarie.targets.c99.types import duration, number


def recent_tables(layout: Layout) -> list[str]:
    """The windows, the places and the truths of both, and what oscillations have besides."""
    starts = [0]
    for count in recent_counts(layout):
        starts.append(starts[-1] + count)
    windows = [(duration(_window_ns(layout, i)), _remark(layout, i)) for i in layout.recent]
    truths = [layout.truth_names[index] for index in layout.recent]
    return [
        remarked_table("int64_t", "recent_windows", windows),
        table("index_t", "recent_first", starts),
        table("index_t", "recent_truth", truths),
        *(_turn_tables(layout) if layout.oscillations else ()),
    ]


def _turn_tables(layout: Layout) -> list[str]:
    swings, values = [], []
    for index in layout.oscillations:
        node = layout.machine.truths[index].node
        assert isinstance(node, ir.Oscillates), "the layout lists oscillations"
        swings.append(number(node.swing))
        values.append(layout.values[layout.value_of_signal[node.signal]].name)
    return [table("double", "turn_swings", swings), table("index_t", "turn_value", values)]


def _window_ns(layout: Layout, index: int) -> int:
    node = layout.machine.truths[index].node
    assert isinstance(node, ir.Oscillates | ir.Recurs), "the layout lists what has a window"
    return node.window_ns


def _remark(layout: Layout, truth: int) -> str:
    declared = layout.machine.truths[truth]
    return f"{names.place(declared.span)}  {declared.text}"
