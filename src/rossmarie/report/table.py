"""The summary of a replay as tables on a terminal, or as plain text in a file or pipe."""

from __future__ import annotations

from typing import TextIO

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from rossmarie.report.model import Replay
from rossmarie.report.rehearsal import TaskSummary, summarize_tasks
from rossmarie.report.spans import Summary, summarize
from rossmarie.report.wording import format_length, format_position

_UNBROKEN = 1_000_000
"""A width, in columns, in which no plain line has to be broken."""


def write_table(replay: Replay, out: TextIO, *, width: int | None = None) -> None:
    """Write one row for each rule and, if the rules would have acted, one row for each task: fitted
    to the width of a terminal, else one line each. With a `width`, `out` reaches a terminal later.
    """
    terminal = None if width is None else True
    console = Console(file=out, width=width, force_terminal=terminal, highlight=False)
    tables = [_table(summarize(replay), styled=console.is_terminal)]
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
    table = Table(box=SIMPLE_HEAD if styled else None, pad_edge=False, header_style="bold")
    table.add_column("Rule", overflow="fold", min_width=8)
    table.add_column("Action", overflow="fold")
    table.add_column("Would do", overflow="fold", min_width=20)
    table.add_column("Times", justify="right", no_wrap=True)
    table.add_column("Overruled", overflow="fold")
    for task in tasks:
        by = ", ".join(f"{count} x by {rule}" for rule, count in task.overruled)
        cells = (task.rule, task.action, task.effect, str(task.starts), by)
        table.add_row(*map(Text, cells))
    return table


def _table(summaries: tuple[Summary, ...], *, styled: bool) -> Table:
    table = Table(box=SIMPLE_HEAD if styled else None, pad_edge=False, header_style="bold")
    table.add_column("Rule", overflow="fold", min_width=8)
    table.add_column("Activations", justify="right", no_wrap=True)
    table.add_column("Active for", justify="right", no_wrap=True)
    table.add_column("Longest", justify="right", no_wrap=True)
    table.add_column("First cause", overflow="fold", min_width=20, ratio=1 if styled else None)
    for summary in summaries:
        table.add_row(*_cells(summary))
    return table


def _cells(summary: Summary) -> tuple[Text, ...]:
    if summary.first_ns is None:
        return Text(summary.rule), Text("never", style="dim"), Text("-"), Text("-"), Text("")
    ending = "; still active at the end" if summary.active_at_end else ""
    return (
        Text(summary.rule, style="bold"),
        Text(str(summary.activations)),
        Text(format_length(summary.total_ns)),
        Text(format_length(summary.longest_ns)),
        Text(f"{format_position(summary.first_ns)}  {summary.first_cause}{ending}"),
    )
