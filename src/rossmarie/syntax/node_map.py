"""Facts about expressions, stored outside the tree, by the identity of the node.

Two equal nodes are different keys: each has its own facts.
"""

from __future__ import annotations

from typing import Generic, TypeVar

from rossmarie.syntax import ast

Fact = TypeVar("Fact")


class NodeMap(Generic[Fact]):
    """A map from nodes to facts of one kind. It keeps its nodes alive, so that no other node gets
    the same identity. `map[node]` for a node without a fact is a defect of this program.
    """

    def __init__(self) -> None:
        self._facts: dict[int, tuple[ast.Expression, Fact]] = {}

    def __setitem__(self, node: ast.Expression, fact: Fact) -> None:
        self._facts[id(node)] = (node, fact)

    def __getitem__(self, node: ast.Expression) -> Fact:
        found = self._facts.get(id(node))
        if found is None:
            raise AssertionError(f"nothing is known about `{node.span.text}`")
        return found[1]

    def __contains__(self, node: ast.Expression) -> bool:
        return id(node) in self._facts

    def get(self, node: ast.Expression) -> Fact | None:
        """The fact about a node; None if the map has none."""
        found = self._facts.get(id(node))
        return None if found is None else found[1]
