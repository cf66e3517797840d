"""The coverage of rules, as a table on a terminal, or as plain text in a file or pipe."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TextIO

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from rossmarie import ir
from rossmarie.testing.coverage import Coverage
from rossmarie.testing.goals import Aspect, TraceGoal, edges

_UNBROKEN = 1_000_000
"""A width, in columns, at which plain lines need no line break."""

_DECIDING = (Aspect.TRUE, Aspect.FALSE)
_BOUNDARIES = (Aspect.UNDER, Aspect.AT, Aspect.OVER)
_CHANGES = (Aspect.ACTIVE, Aspect.CLEARED)


def write_coverage(
    coverage: Coverage, out: TextIO, reasons: Mapping[TraceGoal, str] | None = None
) -> None:
    """Write a row for each rule and each of its conditions, and the sums. `reasons` gives the
    reasons why goals cannot be reached.
    """
    styled = Console(file=out).is_terminal
    print_table(_table(coverage, reasons or {}, styled=styled), out)
    out.write(f"{', '.join(_sums(coverage))}\n")


def print_table(table: Table, out: TextIO) -> None:
    """Print a table fitted to the width of a terminal; elsewhere, print one line for each row."""
    console = Console(file=out, highlight=False)
    if console.is_terminal:
        console.print(table)
    else:
        plain = Console(file=None, width=_UNBROKEN, no_color=True, highlight=False)
        with plain.capture() as capture:
            plain.print(table)
        out.writelines(line.rstrip() + "\n" for line in capture.get().splitlines())


def _table(coverage: Coverage, reasons: Mapping[TraceGoal, str], *, styled: bool) -> Table:
    table = Table(box=SIMPLE_HEAD if styled else None, pad_edge=False, header_style="bold")
    table.add_column("Rule", overflow="fold", min_width=8)
    table.add_column("Condition", overflow="fold", min_width=20)
    table.add_column("MC/DC", justify="right", no_wrap=True)
    table.add_column("Boundaries", justify="right", no_wrap=True)
    table.add_column("Not covered", overflow="fold")
    for rule in sorted({goal.rule for goal in coverage.goals}):
        for cells in _rows(coverage, rule, reasons):
            table.add_row(*map(Text, cells))
    return table


def _rows(
    coverage: Coverage, rule: int, reasons: Mapping[TraceGoal, str]
) -> Iterator[tuple[str, ...]]:
    for place, (text, found) in enumerate(queries(coverage, rule)):
        name = coverage.machine.rules[rule].name if place == 0 else ""
        deciding = [goal for goal in found if goal.aspect in _DECIDING]
        others = [goal for goal in found if goal.aspect in (*_BOUNDARIES, Aspect.STALE)]
        counts = (counted(coverage, deciding), counted(coverage, others))
        yield name, text, *counts, missing(coverage, found, reasons)


def queries(coverage: Coverage, rule: int) -> Iterator[tuple[str, list[TraceGoal]]]:
    """The queries about a rule, in words, with the goals that answer each query."""
    own = [goal for goal in coverage.goals if goal.rule == rule]
    yield "active, and cleared", [goal for goal in own if goal.aspect in _CHANGES]
    groups: dict[tuple[int, int], list[TraceGoal]] = {}
    for goal in own:
        if goal.aspect in (*_DECIDING, *_BOUNDARIES):
            groups.setdefault((goal.subject, goal.decision), []).append(goal)
    for (subject, _), found in groups.items():
        proposition = coverage.machine.propositions[subject]
        yield proposition.name or " ".join(proposition.text.split()), found
    if stale := [goal for goal in own if goal.aspect is Aspect.STALE]:
        yield "stale inputs", stale


def counted(coverage: Coverage, found: Sequence[TraceGoal]) -> str:
    """The number of reached goals, as `2/3`; empty if there are no goals."""
    reached = sum(goal in coverage.reached for goal in found)
    return f"{reached}/{len(found)}" if found else ""


def missing(
    coverage: Coverage, found: Sequence[TraceGoal], reasons: Mapping[TraceGoal, str]
) -> str:
    """The goals that were not reached, in words, with the known reasons."""
    words: dict[str, list[str]] = {}
    for goal in found:
        if goal not in coverage.reached:
            words.setdefault(reasons.get(goal, ""), []).append(describe(coverage.machine, goal))
    parts = [
        ", ".join(several) + (f" ({reason})" if reason else "") for reason, several in words.items()
    ]
    return "; ".join(parts)


def describe(machine: ir.Machine, goal: TraceGoal) -> str:
    """A goal in a word or two: `true`, `just under 10 deg`, `imu stale`."""
    if goal.aspect is Aspect.STALE:
        return f"{machine.inputs[goal.subject].name} stale"
    if goal.aspect not in _BOUNDARIES:
        return str(goal.aspect.value)
    found = edges(machine, goal.subject)
    if not found:
        return f"{goal.aspect.value} the time"
    shown = machine.signals[found[goal.edge].constant]
    number = found[goal.edge].threshold * shown.scale + shown.offset
    return f"{goal.aspect.value} {number:.6g} {shown.unit}".strip()


def _sums(coverage: Coverage) -> Iterator[str]:
    for word, aspects in (
        ("MC/DC", _DECIDING),
        ("boundaries", _BOUNDARIES),
        ("stale inputs", (Aspect.STALE,)),
    ):
        found = [goal for goal in coverage.goals if goal.aspect in aspects]
        reached = sum(goal in coverage.reached for goal in found)
        yield f"{word} {reached} of {len(found)}"
