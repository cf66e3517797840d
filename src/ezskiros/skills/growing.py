"""The behavior tree under construction while `expandBT` runs.

The tree stores nodes without inspecting them. A node can contain a symbol (`values.py`), and a
symbol can change the tree as well: `[Step()] * params.Count` may leave out children.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, TypeVar

from ezskiros.ontology.symbols import UnknownValue

_Node = TypeVar("_Node")
Children = list[Any] | tuple[Any, ...]


class Growing:
    """The tree under construction: its nodes without a parent."""

    def __init__(self) -> None:
        self._loose: dict[int, Any] = {}

    @property
    def loose(self) -> list[Any]:
        """The nodes without a parent, in source order."""
        return list(self._loose.values())

    def add(self, node: object, below: Iterable[object]) -> None:
        """Add a node. The nodes below it are no longer loose."""
        self.drop(below)
        self._loose[id(node)] = node

    def drop(self, those: Iterable[object]) -> None:
        """Remove nodes from the tree."""
        for each in those:
            self._loose.pop(id(each), None)


_growing: ContextVar[Growing | None] = ContextVar("growing", default=None)


@contextmanager
def growing() -> Iterator[Growing]:
    """While the context is active, new nodes belong to one tree."""
    found = Growing()
    token = _growing.set(found)
    try:
        yield found
    finally:
        _growing.reset(token)


def is_growing() -> bool:
    """Say whether a tree is under construction."""
    return _growing.get() is not None


def made(node: _Node, below: Iterable[object] = ()) -> _Node:
    """The node above some nodes, added to the tree under construction, if there is one."""
    tree = _growing.get()
    if tree is not None:
        tree.add(node, below)
    return node


def times(those: Children, count: int) -> Children:
    """Children repeated by a number, as in `[Step()] * params.Count`; none if the number is 0."""
    if count < 1:
        drop(those)
    return those * count


def drop(those: Iterable[object]) -> None:
    """Remove the nodes that were passed to a faulty call, which has been reported."""
    tree = _growing.get()
    if tree is not None:
        tree.drop(those)


class Nowhere(UnknownValue):
    """A stand-in for an unknown processor. It takes children."""

    def __call__(self, *those: object, **_named: object) -> UnknownValue:
        """Accept the children."""
        drop(those)
        return self
