"""The behavior tree under construction while `expandBT` runs.

The tree stores nodes without inspecting them. A node can contain a symbol (`values.py`), and a
symbol can change the tree as well: `[Step()] * params.Count` may leave out children.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, TypeVar

from ezskiros.ontology.things import Unknown

_Node = TypeVar("_Node")
Children = list[Any] | tuple[Any, ...]


class Growing:
    """The tree that is being written: its nodes that are not part of another one yet."""

    def __init__(self) -> None:
        self._loose: dict[int, Any] = {}

    @property
    def loose(self) -> list[Any]:
        """Those in the order in which they are written."""
        return list(self._loose.values())

    def add(self, node: object, below: Iterable[object]) -> None:
        """A node is made of those below it, which are loose no more."""
        self.drop(below)
        self._loose[id(node)] = node

    def drop(self, those: Iterable[object]) -> None:
        """Nodes are left out of the tree."""
        for each in those:
            self._loose.pop(id(each), None)


_growing: ContextVar[Growing | None] = ContextVar("growing", default=None)


@contextmanager
def growing() -> Iterator[Growing]:
    """Within, nodes that are made belong to one tree."""
    found = Growing()
    token = _growing.set(found)
    try:
        yield found
    finally:
        _growing.reset(token)


def is_growing() -> bool:
    """Say whether a tree is being written."""
    return _growing.get() is not None


def made(node: _Node, below: Iterable[object] = ()) -> _Node:
    """The node over those below it, which belongs to the tree that is being written, if any is."""
    tree = _growing.get()
    if tree is not None:
        tree.add(node, below)
    return node


def times(those: Children, count: int) -> Children:
    """Children as often as a number says: `[Step()] * params.Count`; without them if it is 0."""
    if count < 1:
        drop(those)
    return those * count


def drop(those: Iterable[object]) -> None:
    """Nodes that something is given that is wrong, and reported, are no part of the tree."""
    tree = _growing.get()
    if tree is not None:
        tree.drop(those)


class Nowhere(Unknown):
    """A stand-in for a processor that is not there: it takes its children."""

    def __call__(self, *those: object, **_named: object) -> Unknown:
        """Goes on."""
        drop(those)
        return self
