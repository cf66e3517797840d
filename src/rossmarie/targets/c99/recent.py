"""The constant tables of events that are counted within a window: turning points, and edges.

The input is a layout; the result is C text.
"""

from __future__ import annotations

from rossmarie import ir
from rossmarie.targets.c99.layout import CLayout
from rossmarie.targets.c99.state import recent_counts
from rossmarie.targets.c99.text import remarked_table, starts_of, table
from rossmarie.targets.c99.types import duration, number


def recent_tables(layout: CLayout) -> list[str]:
    """The windows, places and propositions of oscillations and counts of edges, and the additional
    data of oscillations.
    """
    windows = [(duration(_window_ns(layout, i)), layout.remark(i)) for i in layout.recent]
    propositions = [layout.proposition_names[index] for index in layout.recent]
    return [
        remarked_table("int64_t", "recent_windows", windows),
        table("index_t", "recent_first", starts_of(recent_counts(layout))),
        table("index_t", "recent_proposition", propositions),
        *(_turn_tables(layout) if layout.oscillations else ()),
    ]


def _turn_tables(layout: CLayout) -> list[str]:
    swings, values = [], []
    for index in layout.oscillations:
        node = layout.machine.propositions[index].node
        assert isinstance(node, ir.Oscillates), "the layout lists oscillations"
        swings.append(number(node.swing))
        values.append(layout.values[layout.value_of_signal[node.signal]].name)
    return [table("double", "turn_swings", swings), table("index_t", "turn_value", values)]


def _window_ns(layout: CLayout, index: int) -> int:
    node = layout.machine.propositions[index].node
    assert isinstance(node, ir.Oscillates | ir.Recurs), "the layout lists what has a window"
    return node.window_ns
