"""Verdicts of a run as data: `verdicts.jsonl` (docs/reference/verdicts.md), schema 1."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from dslkit.source import SourceFile
from ezskiros.learning.errors import NoRecord
from ezskiros.learning.records import RecordLine

SCHEMA = 1
_LONGEST_REASON = 300
"""The most characters of a cause."""


@dataclass(frozen=True)
class Activation:
    """A rule that became active, and the time at which it cleared, at the latest at the end of the
    recording. Time stamps are in nanoseconds. `is_stale` is True if the cause was a stale input and
    not its condition.
    """

    rule: str
    start_ns: int
    end_ns: int
    is_stale: bool
    cause: str


@dataclass(frozen=True)
class Verdicts:
    """The verdicts of one recording: the monitored rules, and their activations."""

    file: SourceFile
    start_ns: int
    end_ns: int
    rules: tuple[str, ...]
    activations: Sequence[Activation]


def is_header(line: RecordLine) -> bool:
    """Say whether a first line is the header of verdicts."""
    return line.values.get("type") == "header"


def read_verdicts(header: RecordLine, rest: Iterable[RecordLine]) -> Verdicts:
    """Verdicts from their lines. Raises `RecordError`."""
    schema = header.get("schema", int)
    if schema != SCHEMA:
        header.fail(f"its `schema` is {schema}, but this EzSkiROS reads {SCHEMA}", "schema")
    start, end = header.stamp("start_ns"), header.stamp("end_ns")
    if start > end:
        header.fail("it ends before it starts", "end_ns")
    rules = header.texts("rules")
    found = sorted(_activations(rest, rules, start, end), key=lambda each: each.start_ns)
    return Verdicts(header.span.file, start, end, rules, found)


def _activations(
    rest: Iterable[RecordLine], rules: Sequence[str], start: int, end: int
) -> Iterator[Activation]:
    """The activations of the rules, each when it is over. Exemptions are left out, because they are
    not rules.
    """
    active: dict[str, tuple[int, RecordLine]] = {}
    last = start
    for line in rest:
        kind = line.get("type", str)
        if kind == "time_jump":
            line.fail("its time stamps jump back here", "from_ns", help=NoRecord.JumpsBack())
        if kind != "verdict":
            continue
        rule, at, is_active = _change(line, rules)
        if not last <= at <= end:
            line.fail("this stamp is earlier than the one before, or outside the run", "at_ns")
        last = at
        if rule in active:
            yield _activation(rule, *active.pop(rule), at)
        if is_active and line.values.get("exempts") is None:
            active[rule] = at, line
    for rule, (since, line) in active.items():
        yield _activation(rule, since, line, end)


def _change(line: RecordLine, rules: Sequence[str]) -> tuple[str, int, bool]:
    rule = line.get("rule", str)
    if rule not in rules:
        line.fail(f"the header has no rule `{rule}`", "rule")
    return rule, line.stamp("at_ns"), line.get("active", bool)


def _activation(rule: str, since: int, line: RecordLine, end: int) -> Activation:
    cause = line.below(line.get("cause", dict)).get("text", str)
    is_stale = line.get("change", str) == "activated_stale"
    return Activation(rule, since, end, is_stale, cause[:_LONGEST_REASON])
