"""Recent instants: the turning points and edges that a monitor keeps, as C over its memory `m`.

The input is a layout. `k` numbers the propositions that use these instants, in the layout's order.
"""

from __future__ import annotations

from rossmarie.ir import model as ir
from rossmarie.verification.layout import ProofLayout


def recent(layout: ProofLayout, k: int) -> ir.Oscillates | ir.Recurs:
    """The k-th of the propositions that count turning points or edges."""
    node = layout.machine.propositions[layout.recent[k]].node
    assert isinstance(node, ir.Oscillates | ir.Recurs), "the layout lists them"
    return node


def first_recent(layout: ProofLayout, k: int) -> int:
    """The place of the first instant that is kept for the k-th proposition."""
    return sum(recent(layout, before).count for before in range(k))


def window_end(layout: ProofLayout, k: int) -> str:
    """The instant at which the oldest stored turning point or edge leaves the window."""
    oldest = f"m->recent_ns[{first_recent(layout, k)} + m->recent_next[{k}]]"
    return f"{oldest} + INT64_C({recent(layout, k).window_ns})"


def enough(layout: ProofLayout, k: int) -> str:
    """State that the window contains at least the number that the proposition asks for (S32,
    S48).
    """
    return f"(m->recent_count[{k}] == {recent(layout, k).count} && t_ns < {window_end(layout, k)})"


def recurs(layout: ProofLayout, proposition: int, operand: str) -> str:
    """S48: known edges are certain. If they are too few, edges that may have been missed count."""
    k = layout.recent.index(proposition)
    end = f"m->gap_end_ns[{k}]"
    near = f"{end} != NEVER && t_ns - {end} < INT64_C({recent(layout, k).window_ns})"
    otherwise = f"{operand} >= UNKNOWN ? {operand} : {near} ? m->gap[{k}] : FALSE"
    return f"{enough(layout, k)} ? TRUE : {otherwise}"
