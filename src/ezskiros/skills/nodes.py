"""Nodes of behavior trees: calls of skills, and what stands over them.

Nodes are made where a tree is written, in `expandBT`; each knows its place there.
"""

from __future__ import annotations

import enum
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from dslkit.source import Span
from ezskiros.ontology.things import Unknown

if TYPE_CHECKING:  # a description is what makes nodes
    from ezskiros.skills.description import SkillDescription
    from ezskiros.skills.values import Symbol


class Flow(enum.Enum):
    """How a node ticks its children: the processors of SkiROS2, by their names there."""

    SERIAL = "Serial"
    SERIAL_STAR = "SerialStar"
    SELECTOR = "Selector"
    SELECTOR_STAR = "SelectorStar"
    PARALLEL_FF = "ParallelFf"
    PARALLEL_FS = "ParallelFs"
    NO_FAIL = "NoFail"


class Decoration(enum.Enum):
    """What stands over a single child."""

    INVERTER = "Inverter"
    RETRY = "Retry"
    TIMEOUT = "Timeout"


@dataclass(frozen=True, eq=False)
class SkillCall:
    """A child that is a skill: `ApproachMovement.go_to_linear(Target=params.GraspPose)`.

    `skill` is its description, `implementation` the name of the one that is wanted; None if any
    does. `arguments` are what the parameters get, as given.
    """

    skill: type[SkillDescription]
    implementation: str | None
    arguments: Mapping[str, object]
    span: Span


@dataclass(frozen=True, eq=False)
class Processor:
    """Children, and how they are ticked."""

    flow: Flow
    children: tuple[Node, ...]
    span: Span


@dataclass(frozen=True, eq=False)
class Decorator:
    """A child, and what becomes of its result. `limit` is the number of tries of a retry, or the
    seconds of a timeout; None of an inverter. It is a symbol until the skill runs if it depends on
    parameters.
    """

    decoration: Decoration
    child: Node
    limit: float | Symbol | None
    span: Span


Node = SkillCall | Processor | Decorator
Children = list[Any] | tuple[Any, ...]


class Growing:
    """The tree that is being written: its nodes that are not part of another one yet."""

    def __init__(self) -> None:
        self._loose: dict[int, Node] = {}

    @property
    def loose(self) -> list[Node]:
        """Those in the order in which they are written."""
        return list(self._loose.values())

    def add(self, node: Node) -> None:
        """A node is made of those below it, which are loose no more."""
        for child in children(node):
            self._loose.pop(id(child), None)
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
    """Whether a tree is being written."""
    return _growing.get() is not None


def made(node: Node) -> Node:
    """The node, which belongs to the tree that is being written, if any is."""
    tree = _growing.get()
    if tree is not None:
        tree.add(node)
    return node


def times(those: Children, count: int) -> Children:
    """Children as often as a number says: `[Step()] * params.Count`; without them if it is 0."""
    if count < 1:
        drop(those)
    return those * count


def drop(those: Iterable[object]) -> None:
    """Nodes that something is given that is wrong, and told, are no part of the tree."""
    tree = _growing.get()
    if tree is not None:
        tree.drop(those)


class Nowhere(Unknown):
    """What stands in for a processor that is not there: it takes its children."""

    def __call__(self, *those: object, **_named: object) -> Unknown:
        """Goes on."""
        drop(those)
        return self


def children(node: Node) -> tuple[Node, ...]:
    """The nodes right below."""
    match node:
        case Processor(children=below):
            return below
        case Decorator(child=child):
            return (child,)
        case SkillCall():
            return ()


def calls(node: Node) -> Iterator[SkillCall]:
    """The skills that a tree calls, in the order in which they are written."""
    if isinstance(node, SkillCall):
        yield node
    for child in children(node):
        yield from calls(child)
