"""The order of statements."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from rossmarie.check.rules.order import in_order

GRAPHS = st.dictionaries(st.integers(0, 8), st.lists(st.integers(0, 8), max_size=4))


def reachable(needs: dict[int, list[int]], start: int) -> set[int]:
    found: set[int] = set()
    pending = list(needs.get(start, ()))
    while pending:
        node = pending.pop()
        if node not in found:
            found.add(node)
            pending.extend(needs.get(node, ()))
    return found


@given(GRAPHS)
def test_every_node_comes_behind_what_it_needs(needs: dict[int, list[int]]) -> None:
    order, circles = in_order(needs)
    assert len(order) == len(set(order))
    assert set(needs) <= set(order)
    if not circles:
        for node, needed in needs.items():
            assert all(order.index(other) < order.index(node) for other in needed)


@given(GRAPHS)
def test_a_circle_is_found_exactly_if_there_is_one(needs: dict[int, list[int]]) -> None:
    _, circles = in_order(needs)
    assert bool(circles) == any(node in reachable(needs, node) for node in needs)
    for circle in circles:
        for node, needed in zip(circle, (*circle[1:], circle[0]), strict=True):
            assert needed in needs[node]


def test_long_chains_need_no_recursion() -> None:
    length = 100_000
    order, circles = in_order({node: [node + 1] for node in range(length)})
    assert order == list(range(length, -1, -1))
    assert circles == []
