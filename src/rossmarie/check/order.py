"""What has to come before what, and where that goes in circles."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence
from typing import TypeVar

Node = TypeVar("Node", bound=Hashable)


def in_order(
    needs: Mapping[Node, Sequence[Node]],
) -> tuple[list[Node], list[tuple[Node, ...]]]:
    """The nodes, each behind those it needs, and the circles met on the way (without recursion).

    Every node of `needs` is in the first list, those of circles somewhere in it.
    """
    order: list[Node] = []
    circles: list[tuple[Node, ...]] = []
    done: set[Node] = set()
    for start in needs:
        path: list[Node] = []
        on_path: dict[Node, int] = {}
        pending: list[Iterator[Node]] = [iter((start,))]
        while pending:
            node = next(pending[-1], None)
            if node is None:
                pending.pop()
                if path:
                    finished = path.pop()
                    del on_path[finished]
                    done.add(finished)
                    order.append(finished)
            elif node in on_path:
                circles.append(tuple(path[on_path[node] :]))
            elif node not in done:
                on_path[node] = len(path)
                path.append(node)
                pending.append(iter(needs.get(node, ())))
    return order, circles
