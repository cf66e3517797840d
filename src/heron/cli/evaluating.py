"""`heron evaluate`: the campaign, its bar, and what is said of it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import typer
from rich.console import Console

from campaign import (
    Bar,
    BusyError,
    Campaign,
    ForeignError,
    Journal,
    UnreachableError,
    Workers,
    run,
)
from dslkit.command_line import INTERRUPTED, CommandLine
from dslkit.writing import reason
from heron.evaluation import Folder, keys_of, row_of, sources, write_page
from heron.experiments import EXPERIMENTS

_KEPT = "what is done is kept, and the same command goes on from there"


def evaluate(
    output: CommandLine,
    names: Sequence[str],
    seeds: int,
    out: Path,
    workers: Workers,
) -> None:
    """Run what is not in the journal, and write the page."""
    folder = Folder(out)
    keys = list(keys_of([EXPERIMENTS[name] for name in names], seeds))
    try:
        found = _campaign(keys, folder, workers)
    except KeyboardInterrupt:
        output.fail(f"interrupted; {_KEPT}", exit_code=INTERRUPTED)
    except BusyError as error:
        output.fail(str(error), exit_code=2)
    except UnreachableError as error:
        output.fail(f"{error}; {_KEPT}", exit_code=2)
    except ForeignError as error:
        output.fail(f"{error}; remove it, or choose another folder by --out", exit_code=2)
    except OSError as error:
        output.fail(f"cannot write to {out}: {reason(error)}; {_KEPT}", exit_code=2)
    if found.values:
        with output.writing_to(out):
            typer.echo(f"the page:  {write_page(folder, found.values)}")
    if found.failures:
        names = ", ".join(failure.key for failure in found.failures)
        output.fail(f"not finished, and tried again by the same command: {names}", exit_code=1)


def _campaign(keys: Sequence[str], folder: Folder, workers: Workers) -> Campaign:
    with (
        Journal(folder.journal, sources()) as journal,
        Bar(Console(stderr=True), "episodes") as bar,
    ):
        return run(keys, row_of, journal, workers, bar)
