"""A topological order, and the circles that prevent it."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence
from typing import TypeVar

Node = TypeVar("Node", bound=Hashable)

LONGEST_CIRCLE = 8
"""The most members of a circle that a message shows."""


def circle_of(names: Sequence[str], between: str = " -> ") -> str:
    """`a -> b -> a`. The middle of a long circle is left out."""
    is_short = len(names) <= LONGEST_CIRCLE
    shown = names if is_short else [*names[: LONGEST_CIRCLE - 1], "..."]
    return between.join((*shown, names[0]))


def in_order(
    needs: Mapping[Node, Sequence[Node]],
) -> tuple[list[Node], list[tuple[Node, ...]]]:
    """The nodes, each after the nodes that it needs, and disjoint circles of nodes.

    Every node of `needs` is in the first list; nodes of circles are at arbitrary positions. If
    there is any circle, at least one is returned. The function does not recurse.
    """
    order: list[Node] = []
    circles: list[tuple[Node, ...]] = []
    in_circles: set[Node] = set()
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
                circle = tuple(path[on_path[node] :])
                if in_circles.isdisjoint(circle):
                    in_circles.update(circle)
                    circles.append(circle)
            elif node not in done:
                on_path[node] = len(path)
                path.append(node)
                pending.append(iter(needs.get(node, ())))
    return order, circles
