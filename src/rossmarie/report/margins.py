"""The margins of thresholds, as a table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TextIO

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from rossmarie import ir
from rossmarie.report.coverage import print_table
from rossmarie.report.spare import MEANING, spares
from rossmarie.testing.margins import ThresholdMargin


def write_margins(machine: ir.Machine, margins: Sequence[ThresholdMargin], out: TextIO) -> None:
    """Write a row for each threshold and duration."""
    styled = Console(file=out).is_terminal
    table = Table(box=SIMPLE_HEAD if styled else None, pad_edge=False, header_style="bold")
    table.add_column("Threshold", overflow="fold", min_width=20)
    table.add_column("Is", justify="right", no_wrap=True)
    for head in ("Same from", "to", "As often from", "to"):
        table.add_column(head, justify="right", no_wrap=True)
    for each in spares(machine, margins):
        table.add_row(*map(Text, (each.name, *each.cells)))
    print_table(table, out)
    out.write(f"{MEANING}\n")
