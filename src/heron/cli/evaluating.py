"""`heron evaluate`: the campaign and its progress bar."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

from rich.console import Console

from dslkit.campaign import Bar, Campaign, Journal, Workers, run
from dslkit.command_line import CommandLine
from heron.cli.campaigns import carry_out
from heron.cli.choices import require_campaign
from heron.evaluation import PAGE, Folder, keys_of, row_of, sources, write_page
from heron.experiments import EXPERIMENTS


def evaluate(
    output: CommandLine,
    names: Sequence[str],
    seeds: int,
    out: Path,
    workers: Workers,
) -> None:
    """Run the episodes that are not in the journal, and write the page."""
    folder = Folder(out)
    require_campaign(out, PAGE, folder.journal)
    keys = list(keys_of([EXPERIMENTS[name] for name in names], seeds))
    carry_out(output, out, lambda: _campaign(keys, folder, workers), partial(write_page, folder))


def _campaign(keys: Sequence[str], folder: Folder, workers: Workers) -> Campaign:
    with (
        Journal(folder.journal, sources()) as journal,
        Bar(Console(stderr=True), "episodes") as bar,
    ):
        return run(keys, row_of, journal, workers, bar)
