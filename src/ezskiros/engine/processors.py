"""The processors of SkiROS2, and decorators, as behaviors of py_trees.

Sequences and selectors of py_trees behave like those of SkiROS2, with memory for the processors
with a star. The parallel of py_trees ticks all children before it examines results, while that of
SkiROS2 stops at the first deciding child; so EzSkiROS has its own.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence

from py_trees import behaviours, composites, decorators
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from ezskiros.engine.events import Code, Reason
from ezskiros.engine.execution_context import ExecutionContext
from ezskiros.skills.nodes import Decoration, Decorator, Flow
from ezskiros.skills.values import Symbol

_DECIDES = {Flow.PARALLEL_FF: {Status.FAILURE}, Flow.PARALLEL_FS: {Status.FAILURE, Status.SUCCESS}}


def processor(
    flow: Flow, children: Sequence[Behaviour], *, is_compatible: bool = False
) -> Behaviour:
    """A processor with children. If it is compatible with SkiROS2, a parallel restarts children
    that have succeeded while others still run, and a processor without children runs forever.
    """
    if is_compatible and not children:
        return behaviours.Running(flow.value)
    match flow:
        case Flow.SERIAL | Flow.SERIAL_STAR:
            return _Sequence(flow.value, memory=flow is Flow.SERIAL_STAR, children=children)
        case Flow.SELECTOR | Flow.SELECTOR_STAR:
            return _Selector(flow.value, memory=flow is Flow.SELECTOR_STAR, children=children)
        case Flow.NO_FAIL:
            inner = processor(Flow.SERIAL_STAR, children)
            return _NoFail(flow.value, inner)
        case Flow.PARALLEL_FF | Flow.PARALLEL_FS:
            return _Parallel(flow, children, restarts=is_compatible)


def decorator(node: Decorator, child: Behaviour, execution: ExecutionContext) -> Behaviour:
    """A decorator around a child."""
    name, limit = node.decoration.value, node.limit or 0
    assert not isinstance(limit, Symbol), "a tree that starts is built for values"
    match node.decoration:
        case Decoration.INVERTER:
            return _Inverter(name, child, node, execution)
        case Decoration.RETRY:
            return _Retry(name, child, int(limit))
        case Decoration.TIMEOUT:
            return _Timeout(child, limit, node, execution)


class _Alone(Behaviour):
    """A behavior that yields only itself in a tick. The behaviors of py_trees yield all nodes below
    them, so that the time for a tree grows with the square of its depth; nothing here needs these
    nodes.
    """

    def tick(self) -> Iterator[Behaviour]:
        """Tick the behavior once."""
        deque(super().tick(), maxlen=0)
        yield self


class _Sequence(_Alone, composites.Sequence): ...


class _Selector(_Alone, composites.Selector): ...


class _NoFail(_Alone, decorators.FailureIsSuccess): ...


class _Retry(_Alone, decorators.Retry): ...


class _Inverter(_Alone, decorators.Inverter):
    """An inverter that gives the reason of its failure: the success of its child."""

    def __init__(
        self, name: str, child: Behaviour, node: Decorator, execution: ExecutionContext
    ) -> None:
        super().__init__(name, child)
        self._node, self._execution = node, execution

    def update(self) -> Status:
        """The inverted result of the child."""
        status = super().update()
        if status is Status.FAILURE:
            text = f"the inverted child has succeeded ({self._node.span})"
            self._execution.last_failure = Reason(Code.EXECUTION, text)
        return status


class _Timeout(_Alone, decorators.Decorator):
    """Fails if its child has no result in time, by the clock of the task."""

    def __init__(
        self, child: Behaviour, seconds: float, node: Decorator, execution: ExecutionContext
    ) -> None:
        super().__init__(node.decoration.value, child)
        self._seconds, self._node, self._execution, self._end = seconds, node, execution, 0.0

    def initialise(self) -> None:
        """Start the time."""
        self._end = self._execution.clock() + self._seconds

    def update(self) -> Status:
        """The result of the child, or failure after the time limit."""
        status = self.decorated.status
        if status is not Status.RUNNING or self._execution.clock() < self._end:
            return status
        self.decorated.stop(Status.INVALID)
        text = f"no result within {self._seconds:g} s ({self._node.span})"
        self._execution.last_failure = Reason(Code.EXECUTION, text)
        return Status.FAILURE


class _Parallel(composites.Composite):
    """Ticks all children in one tick, until one decides or all have succeeded."""

    def __init__(self, flow: Flow, children: Sequence[Behaviour], *, restarts: bool) -> None:
        super().__init__(flow.value, children)
        self._decides = _DECIDES[flow]
        self._restarts = restarts

    def tick(self) -> Iterator[Behaviour]:
        """Tick the children once."""
        skips = self.status is Status.RUNNING and not self._restarts
        self.status = Status.RUNNING
        result = Status.SUCCESS
        for child in self.children:
            if skips and child.status is Status.SUCCESS:
                continue
            for _ in child.tick():
                pass
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
