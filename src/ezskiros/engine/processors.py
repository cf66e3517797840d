"""The processors of SkiROS2 as behaviors of py_trees.

Sequences and selectors of py_trees do what SkiROS2's do, with memory for those with a star. Its
parallel ticks all children before it looks at results, that of SkiROS2 stops at the first that
decides; so this one is ours.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import py_trees
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from ezskiros.skills.nodes import Decoration, Flow

_DECIDES = {Flow.PARALLEL_FF: {Status.FAILURE}, Flow.PARALLEL_FS: {Status.FAILURE, Status.SUCCESS}}


def processor(flow: Flow, children: Sequence[Behaviour], *, restarts: bool) -> Behaviour:
    """A processor over children. With `restarts` a parallel starts children that succeeded again
    while others still run, as in SkiROS2.
    """
    match flow:
        case Flow.SERIAL | Flow.SERIAL_STAR:
            is_kept = flow is Flow.SERIAL_STAR
            return py_trees.composites.Sequence(flow.value, memory=is_kept, children=[*children])
        case Flow.SELECTOR | Flow.SELECTOR_STAR:
            is_kept = flow is Flow.SELECTOR_STAR
            return py_trees.composites.Selector(flow.value, memory=is_kept, children=[*children])
        case Flow.NO_FAIL:
            inner = processor(Flow.SERIAL_STAR, children, restarts=restarts)
            return py_trees.decorators.FailureIsSuccess(flow.value, inner)
        case _:
            return Parallel(flow, children, restarts=restarts)


def decorator(decoration: Decoration, child: Behaviour, limit: float | None) -> Behaviour:
    """A decorator around a child."""
    match decoration:
        case Decoration.INVERTER:
            return py_trees.decorators.Inverter(decoration.value, child)
        case Decoration.RETRY:
            return py_trees.decorators.Retry(decoration.value, child, int(limit or 1))
        case Decoration.TIMEOUT:
            return py_trees.decorators.Timeout(decoration.value, child, limit or 0.0)


class Parallel(py_trees.composites.Composite):
    """All children in one tick, until one decides or all have succeeded."""

    def __init__(self, flow: Flow, children: Sequence[Behaviour], *, restarts: bool) -> None:
        super().__init__(flow.value, [*children])
        self._decides = _DECIDES[flow]
        self._restarts = restarts

    def tick(self) -> Iterator[Behaviour]:
        """One tick; yields the behaviors that were ticked."""
        is_fresh = self.status is not Status.RUNNING
        if is_fresh:
            self.initialise()
        result = Status.SUCCESS
        for child in self.children:
            if child.status is Status.SUCCESS and not is_fresh and not self._restarts:
                continue
            yield from child.tick()
            if child.status in self._decides:
                result = child.status
                self._stop_others(child)
                break
            if child.status is Status.RUNNING:
                result = Status.RUNNING
        self.status = result
        yield self

    def _stop_others(self, decided: Behaviour) -> None:
        for child in self.children:
            if child is not decided and child.status is Status.RUNNING:
                child.stop(Status.INVALID)
