"""Processors of SkiROS2 nodes, which tick their children: SkiROS2's own processors, and those that
SkiROS2 does not have.

A processor is any object with these three methods. Its children report SkiROS2's `State`.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

from ezskiros.hosts.skiros2_api import api
from ezskiros.skills.nodes import Decoration, Flow


def processor(name: str, limit: float | None) -> Any:
    """The processor or decorator of a node, such as `SerialStar`."""
    if name == Flow.NO_FAIL.value:
        return api().processors.NoFail(api().processors.SerialStar())
    if name == Flow.PARALLEL_FF.value:
        return ParallelFf()
    if name in {each.value for each in Flow}:
        return getattr(api().processors, name)()
    made: Callable[..., Any] = _DECORATORS[Decoration(name)]
    return made() if limit is None else made(limit)


class ParallelFf:
    """Runs all children until all have succeeded or one fails.

    SkiROS2's own processor restarts children that have succeeded, in each tick, until all succeed
    in the same tick.
    """

    def __init__(self) -> None:
        self._done: set[int] = set()

    def printType(self) -> str:  # noqa: N802 - as in SkiROS2
        """The symbol in SkiROS2's drawing."""
        return "|ff|"

    def reset(self) -> None:
        """Reset the state before the first tick."""
        self._done.clear()

    def processChildren(self, children: Sequence[Any], visitor: Any) -> Any:  # noqa: N802
        """Tick the children once."""
        state = api().State
        is_done = True
        for child in children:
            if id(child) in self._done:
                continue
            found = child.visit(visitor)
            if found == state.Failure:
                self._end(children, visitor)
                return found
            if found == state.Success:
                self._done.add(id(child))
            else:
                is_done = False
        if not is_done:
            return state.Running
        self._done.clear()
        return state.Success

    def _end(self, children: Sequence[Any], visitor: Any) -> None:
        self._done.clear()
        for child in children:
            if child.state == api().State.Running:
                child.visitPreempt(visitor)


class Inverter:
    """Exchanges success and failure."""

    def printType(self) -> str:  # noqa: N802
        """The symbol in the drawing of the tree."""
        return "!"

    def reset(self) -> None:
        """Do nothing: an inverter has no state."""

    def processChildren(self, children: Sequence[Any], visitor: Any) -> Any:  # noqa: N802
        """Tick the child once."""
        state = api().State
        found = children[0].visit(visitor)
        return {state.Success: state.Failure, state.Failure: state.Success}.get(found, found)


class Retry:
    """Restarts a failed child in the next tick, for at most `tries` tries in all."""

    def __init__(self, tries: float) -> None:
        self._tries, self._failures = tries, 0

    def printType(self) -> str:  # noqa: N802
        """The symbol in the drawing of the tree."""
        return f"retry({self._tries:g})"

    def reset(self) -> None:
        """Reset the state before the first tick."""
        self._failures = 0

    def processChildren(self, children: Sequence[Any], visitor: Any) -> Any:  # noqa: N802
        """Tick the child once."""
        state = api().State
        found = children[0].visit(visitor)
        if found == state.Success:
            self._failures = 0
        elif found == state.Failure:
            self._failures += 1
            if self._failures < self._tries:
                return state.Running
            self._failures = 0
        return found


class Timeout:
    """Fails if there is no result after some seconds."""

    def __init__(self, seconds: float, clock: Callable[[], float] = time.monotonic) -> None:
        self._seconds, self._clock = seconds, clock
        self._end: float | None = None

    def printType(self) -> str:  # noqa: N802
        """The symbol in the drawing of the tree."""
        return f"timeout({self._seconds:g} s)"

    def reset(self) -> None:
        """Reset the state before the first tick."""
        self._end = None

    def processChildren(self, children: Sequence[Any], visitor: Any) -> Any:  # noqa: N802
        """Tick the child once."""
        state = api().State
        if self._end is None:
            self._end = self._clock() + self._seconds
        found = children[0].visit(visitor)
        if found == state.Running:
            if self._clock() < self._end:
                return found
            children[0].visitPreempt(visitor)
            found = state.Failure
        self._end = None
        return found


_DECORATORS = {
    Decoration.INVERTER: Inverter,
    Decoration.RETRY: Retry,
    Decoration.TIMEOUT: Timeout,
}
