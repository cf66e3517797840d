"""`heron demo`: episodes with and without the monitor, as a table and as a page."""

from __future__ import annotations

from pathlib import Path

import typer
from rich.console import Console
from rich.table import Table

from dslkit.command_line import CommandLine
from heron.demo import Shot, page_of, shoot_all
from heron.experiments import EXPERIMENTS
from heron.experiments.experiment import ARM_NAMES


def demonstrate(output: CommandLine, seed: int, out: Path) -> None:
    """Run the episodes, print the comparison, write the page."""
    console = Console(highlight=False)
    with Console(stderr=True).status("the experiments are running"):
        shots = shoot_all(seed)
    for name in EXPERIMENTS:
        console.print(_table([shot for shot in shots if shot.experiment == name]))
    with output.writing(out):
        out.parent.mkdir(parents=True, exist_ok=True)
    output.save(out, page_of(shots))
    trouble = next((shot.frames.trouble for shot in shots if shot.frames.trouble), None)
    if trouble is not None:
        output.complain(f"the page has no pictures: {trouble}")
    typer.echo(f"the page:  {out}")


def _table(shots: list[Shot]) -> Table:
    first = shots[0]
    title = f"Experiment {EXPERIMENTS[first.experiment].title}: {first.title}"
    table = Table("measure", *(ARM_NAMES[shot.arm] for shot in shots), title=title)
    table.title_justify = "left"
    for column in table.columns[1:]:
        column.justify = "right"
    for label in dict.fromkeys(label for shot in shots for label in shot.measures):
        table.add_row(label, *(shot.measures.get(label, "-") for shot in shots))
    return table
