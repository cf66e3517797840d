"""How far thresholds can go, as a table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TextIO

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from rossmarie import ir
from rossmarie.report.coverage import print_table
from rossmarie.testing.margins import Margin

_MEANING = (
    "Between the first two values every verdict stays as it is, to the instant; between the "
    "last two each rule becomes active and is cleared as often, perhaps earlier or later."
)


def write_margins(machine: ir.Machine, margins: Sequence[Margin], out: TextIO) -> None:
    """Write a row for each threshold and duration."""
    styled = Console(file=out).is_terminal
    table = Table(box=SIMPLE_HEAD if styled else None, pad_edge=False, header_style="bold")
    table.add_column("Threshold", overflow="fold", min_width=20)
    table.add_column("Is", justify="right", no_wrap=True)
    for head in ("Same from", "to", "As often from", "to"):
        table.add_column(head, justify="right", no_wrap=True)
    for each in margins:
        ends = (each.same.low, each.same.high, each.as_often.low, each.as_often.high)
        values = (each.threshold.value, *ends)
        cells = (each.threshold.text, *(_shown(machine, each, value) for value in values))
        table.add_row(*map(Text, cells))
    print_table(table, out)
    out.write(f"{_MEANING}\n")


def _shown(machine: ir.Machine, margin: Margin, value: float | None) -> str:
    """A value in the unit of its threshold; `any` if nothing changes however far it goes."""
    if value is None:
        return "any"
    if margin.threshold.constant is None:
        return f"{value:.6g} s"
    shown = machine.signals[margin.threshold.constant]
    return f"{value * shown.scale + shown.offset:.6g} {shown.unit}".strip()
