"""Nodes of behavior trees: calls of skills, and the processors and decorators above them.

Nodes are created where a tree is written, in `expandBT`. Each node knows its place there.
"""

from __future__ import annotations

import enum
from collections.abc import Iterator
from dataclasses import dataclass

from dslkit.source import Span
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.values import Symbol


class Flow(enum.Enum):
    """The order in which a node ticks its children: the processors of SkiROS2, by their SkiROS2
    names.
    """

    SERIAL = "Serial"
    SERIAL_STAR = "SerialStar"
    SELECTOR = "Selector"
    SELECTOR_STAR = "SelectorStar"
    PARALLEL_FF = "ParallelFf"
    PARALLEL_FS = "ParallelFs"
    NO_FAIL = "NoFail"


class Decoration(enum.Enum):
    """The kind of a node with a single child."""

    INVERTER = "Inverter"
    RETRY = "Retry"
    TIMEOUT = "Timeout"


@dataclass(frozen=True, eq=False)
class Processor:
    """A node with children, and the order of their ticks."""

    flow: Flow
    children: tuple[Node, ...]
    span: Span


@dataclass(frozen=True, eq=False)
class Decorator:
    """A child with a changed result. `limit` is the number of tries of a retry, or the seconds of a
    timeout; None for an inverter. It is a symbol until the skill runs if it depends on parameters.
    """

    decoration: Decoration
    child: Node
    limit: float | Symbol | None
    span: Span


Node = SkillCall | Processor | Decorator


def children(node: Node) -> tuple[Node, ...]:
    """The direct children of a node."""
    match node:
        case Processor(children=below):
            return below
        case Decorator(child=child):
            return (child,)
        case SkillCall():
            return ()


def calls(node: Node) -> Iterator[SkillCall]:
    """The skills that a tree calls, in source order."""
    if isinstance(node, SkillCall):
        yield node
    for child in children(node):
        yield from calls(child)
