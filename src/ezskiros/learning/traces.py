"""Traces of a run as data: `ezskiros run --trace` (docs/reference/skill-trace.md)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from dslkit.source import SourceFile
from ezskiros.learning.errors import NoRecord
from ezskiros.learning.records import RecordLine

_ENDS = ("succeeded", "failed", "preempted")
_EVENTS = ("started", "running", "chosen", "context", *_ENDS)
_LONGEST_REASON = 300
"""The most characters of the reason of a failure."""


@dataclass(frozen=True)
class Execution:
    """One run of a skill, from its start to its end, in nanoseconds. `values` are the values of its
    parameters that are texts, including IRIs of individuals. `outcome` is `succeeded`, `failed` or
    `preempted`; `reason` is the reason of a failure. An execution that failed before its start has
    no duration and no values.
    """

    path: tuple[str, ...]
    skill: str
    start_ns: int
    end_ns: int
    values: Mapping[str, str]
    outcome: str = "preempted"
    reason: str = ""


@dataclass(frozen=True)
class TaskTrace:
    """All executions of one run of a task, in the order of their ends."""

    file: SourceFile
    start_ns: int
    end_ns: int
    executions: Sequence[Execution]


def is_event(line: RecordLine) -> bool:
    """Say whether a first line belongs to a trace."""
    return line.values.get("event") in _EVENTS


def read_trace(first: RecordLine, rest: Iterable[RecordLine]) -> TaskTrace:
    """A trace from its lines. Raises `RecordError`."""
    reader = _Reader(first)
    for line in (first, *rest):
        reader.take(line)
    return reader.trace()


class _Reader:
    """The executions up to the current line."""

    def __init__(self, first: RecordLine) -> None:
        self._first = self._last_line = first
        self._start = self._last = _stamp(first)
        self._running: dict[tuple[str, ...], Execution] = {}
        self._found: list[Execution] = []

    def trace(self) -> TaskTrace:
        if self._running:
            path = " > ".join(next(iter(self._running)))
            self._last_line.fail(f"it ends here while `{path}` runs")
        if not self._found:
            self._first.fail("it contains no skill")
        return TaskTrace(self._first.span.file, self._start, self._last, self._found)

    def take(self, line: RecordLine) -> None:
        at, event = _stamp(line), line.get("event", str)
        if at < self._last:
            line.fail("this stamp is earlier than the one before", "at_ns")
        self._last, self._last_line = at, line
        if event != "started" and event not in _ENDS:
            return
        path, skill = line.texts("path"), line.get("skill", str)
        if not path:
            line.fail("`path` names no skill", "path")
        text = line.get("text", str)[:_LONGEST_REASON]
        if event == "started":
            self._end(path, at)
            self._running[path] = Execution(path, skill, at, at, _texts(line))
        elif path in self._running:
            self._end(path, at, event, text)
        elif event == "failed":  # the skill could not start
            self._found.append(Execution(path, skill, at, at, {}, event, text))

    def _end(
        self, path: tuple[str, ...], at: int, outcome: str = "preempted", text: str = ""
    ) -> None:
        """End the execution at a path, and all executions below it."""
        for other in self._below(path):
            ended = replace(self._running.pop(other), end_ns=at)
            if other == path:
                ended = replace(ended, outcome=outcome, reason=text)
            self._found.append(ended)

    def _below(self, path: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
        found = [each for each in self._running if each[: len(path)] == path]
        yield from sorted(found, key=len, reverse=True)


def _stamp(line: RecordLine) -> int:
    if "at_ns" not in line.values:
        line.fail("`at_ns` is missing", "time", help=NoRecord.WithoutStamp())
    return line.stamp("at_ns")


def _texts(line: RecordLine) -> Mapping[str, str]:
    """The values that are texts; empty for a skill without parameters."""
    if "parameters" not in line.values:
        return {}
    found = line.get("parameters", dict)
    return {name: value for name, value in found.items() if isinstance(value, str)}
