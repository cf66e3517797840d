"""Primitive skills that do what a script says, in trees of the engine, and what comes of them.

The notation is that of the recorded traces of SkiROS2. A script has a letter for each tick: R
running, S success, F failure; the last one repeats. A trace has for each tick what was called (`a^`
onStart of the child a, `aR` its result, `a$` onEnd, `a!` onPreempt), then `=` and the state of the
tree.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from types import MappingProxyType
from typing import Any, ClassVar

from py_trees.common import Status

from ezskiros import SkillDescription
from ezskiros.engine.build import behavior
from ezskiros.engine.execution_context import ExecutionContext
from ezskiros.engine.grounding import SharedValues
from ezskiros.engine.world import World
from ezskiros.ontology import Ontology
from ezskiros.session import NOWHERE
from ezskiros.skills.calls import SkillCall
from ezskiros.skills.implementation import State
from ezskiros.skills.nodes import Flow, Node, Processor
from ezskiros.trees.library import Library

MOST_TICKS = 8
_RESULTS = {"R": State.RUNNING, "S": State.SUCCESS, "F": State.FAILURE}
_DEFAULT = "S,RS,RS"


class Scripted(SkillDescription):
    def description(self, Letter: str, Script: str) -> None:  # noqa: N803
        """A skill that notes its calls."""


class scripted(Scripted.SkillBase):  # noqa: N801
    log: ClassVar[list[str]] = []

    def onStart(self) -> bool:  # noqa: N802
        self.count = 0
        self._note("^")
        return True

    def execute(self) -> State:
        script: str = self.params.Script
        letter = script[min(self.count, len(script) - 1)]
        self.count += 1
        self._note(letter)
        return _RESULTS[letter]

    def onPreempt(self) -> State:  # noqa: N802
        self._note("!")
        return State.FAILURE

    def onEnd(self) -> bool:  # noqa: N802
        self._note("$")
        return True

    def _note(self, sign: str) -> None:
        self.log.append(f"{self.params.Letter}{sign}")


def child(letter: str, script: str) -> SkillCall:
    """A child that does what a script says."""
    arguments: dict[str, Any] = {"Letter": letter, "Script": script}
    return SkillCall(Scripted, None, MappingProxyType(arguments), NOWHERE)


def processor(flow: Flow, *children: Node) -> Processor:
    return Processor(flow, children, NOWHERE)


def tree(described: str) -> Node:
    """The tree of `Serial>ParallelFf S,RS,F`: Serial(ParallelFf(a, b), c)."""
    kind, _, scripts = described.partition(" ")
    scripted_children = (scripts or _DEFAULT).split(",")
    children = [child("abcdefgh"[i], script) for i, script in enumerate(scripted_children)]
    if inner := re.fullmatch(r"NoFail\((\w+)\)", kind):
        flow = Flow(inner[1])
        below = children if flow is Flow.SERIAL_STAR else [processor(flow, *children)]
        return processor(Flow.NO_FAIL, *below)
    outer, _, below_outer = kind.partition(">")
    if below_outer:
        return processor(Flow(outer), processor(Flow(below_outer), *children[:-1]), children[-1])
    return processor(Flow(outer), *children)


def traced(root: Node, *, compatible: bool, ticks: int = MOST_TICKS) -> list[str]:
    """The events, tick by tick, until there is a result."""
    execution = ExecutionContext(Library({}), World(Ontology(())), compatible=compatible)
    running = behavior(root, SharedValues({}), execution, None)
    found = []
    for _ in range(ticks):
        scripted.log.clear()
        running.tick_once()
        found.append(f"{''.join(scripted.log)}={running.status.name[0]}")
        if running.status is not Status.RUNNING:
            break
    return found


def traces(described: Sequence[str], *, compatible: bool) -> dict[str, list[str]]:
    """The events in some trees."""
    return {each: traced(tree(each), compatible=compatible) for each in described}
