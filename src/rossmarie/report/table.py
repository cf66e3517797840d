"""The summary of a replay as tables on a terminal, or as plain text in a file or pipe."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TextIO

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.measure import Measurement
from rich.table import Table
from rich.text import Text

from rossmarie.report.model import Replay
from rossmarie.report.rehearsal import TaskSummary, summarize_tasks
from rossmarie.report.spans import Summary, summarize
from rossmarie.report.wording import format_length, format_position

_DETAILS = re.compile(
    r", true since [-\d.]+ s|, \w+ = (?:\[[^\]]*\]|[-\d.]+)[^,;]*(?=[,;]|$)|(?<=  )[\w.]+: "
)
"""The parts of a cause that its short form leaves out."""
_GAPS = 5
"""The columns of a terminal between two columns of a table."""
_UNBROKEN = 1_000_000
"""A width, in columns, at which plain lines need no line break."""


def write_table(replay: Replay, out: TextIO, *, width: int | None = None) -> None:
    """Write one row for each rule and, if the rules would have acted, one row for each task. On a
    terminal the table fits its width; elsewhere, each row is one line. Give `width` if `out`
    reaches a terminal later.
    """
    terminal = None if width is None else True
    console = Console(file=out, width=width, force_terminal=terminal, highlight=False)
    tables = [*_tables(summarize(replay), console)]
    if replay.rehearsed:
        tasks = summarize_tasks(replay.machine, replay.rehearsed)
        tables.append(_task_table(tasks, styled=console.is_terminal))
    if console.is_terminal:
        console.print(*tables)
        return
    plain = Console(file=None, width=_UNBROKEN, no_color=True, highlight=False)
    with plain.capture() as capture:
        for place, table in enumerate(tables):
            plain.print(*([""] if place else []), table, sep="\n")
    out.writelines(line.rstrip() + "\n" for line in capture.get().splitlines())


def _task_table(tasks: tuple[TaskSummary, ...], *, styled: bool) -> Table:
    table = _empty(styled=styled)
    table.add_column("Action", overflow="fold")
    table.add_column("Would do", overflow="fold", min_width=20)
    table.add_column("Times", justify="right", no_wrap=True)
    table.add_column("Overruled", overflow="fold")
    for task in tasks:
        by = ", ".join(f"{count} x by {rule}" for rule, count in task.overruled)
        cells = (task.rule, task.action, task.effect, str(task.starts), by)
        table.add_row(*map(Text, cells))
    return table


def _tables(summaries: tuple[Summary, ...], console: Console) -> Iterator[Table]:
    """The table of rules. On a terminal that is too narrow for it, a second table contains the
    causes, with one line each.
    """
    styled = console.is_terminal
    whole = _empty(styled=styled)
    _add_counts(whole)
    whole.add_column("First cause", overflow="fold", min_width=20, ratio=1 if styled else None)
    for summary in summaries:
        whole.add_row(*_counts(summary), _cause(summary))
    wide = console.options.update(max_width=_UNBROKEN)
    if not styled or Measurement.get(console, wide, whole).maximum <= console.width:
        yield whole
        return
    counts, causes = _empty(styled=True), _empty(styled=True)
    _add_counts(counts)
    longest = max((len(summary.rule) for summary in summaries), default=1)
    causes.columns[0].width = min(longest, console.width // 3)
    causes.add_column("First cause", overflow="ellipsis", no_wrap=True)
    causes.columns[1].width = max(console.width - causes.columns[0].width - _GAPS, 1)
    for summary in summaries:
        counts.add_row(*_counts(summary))
        if summary.first_ns is not None:
            causes.add_row(Text(summary.rule, style="bold"), _short(_cause(summary)))
    yield counts
    if causes.row_count:
        yield causes


def _empty(*, styled: bool) -> Table:
    """A table with the column of the rules."""
    table = Table(box=SIMPLE_HEAD if styled else None, pad_edge=False, header_style="bold")
    table.add_column("Rule", overflow="fold", min_width=8)
    return table


def _add_counts(table: Table) -> None:
    for name in ("Activations", "Active for", "Longest"):
        table.add_column(name, justify="right", no_wrap=True)


def _counts(summary: Summary) -> tuple[Text, ...]:
    if summary.first_ns is None:
        return Text(summary.rule), Text("never", style="dim"), Text("-"), Text("-")
    return (
        Text(summary.rule, style="bold"),
        Text(str(summary.activations)),
        Text(format_length(summary.total_ns)),
        Text(format_length(summary.longest_ns)),
    )


def _short(cause: Text) -> Text:
    """A cause without the times of its conditions and the values of its constants, which the
    timeline shows.
    """
    return Text(_DETAILS.sub("", cause.plain))


def _cause(summary: Summary) -> Text:
    if summary.first_ns is None:
        return Text("")
    ending = "; still active at the end" if summary.active_at_end else ""
    return Text(f"{format_position(summary.first_ns)}  {summary.first_cause}{ending}")
