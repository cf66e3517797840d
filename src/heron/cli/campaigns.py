"""Campaigns on the command line: the reasons for an early end, and the page at the end."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import typer

from dslkit.campaign import BusyError, Campaign, ForeignError, UnreachableError, Value
from dslkit.command_line import CommandLine
from dslkit.ending import INTERRUPTED
from dslkit.writing import reason

_KEPT = "finished work is kept; run the same command again to continue"


def carry_out(
    output: CommandLine,
    out: Path,
    run: Callable[[], Campaign],
    write_page: Callable[[Mapping[str, Value]], Path],
) -> None:
    """Run a campaign whose results go into the folder `out`, and write the page of its rows. Ends
    the program if something was not finished.
    """
    try:
        found = run()
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
            typer.echo(f"the page:  {write_page(found.values)}")
    if found.failures:
        names = ", ".join(failure.key for failure in found.failures)
        output.fail(f"not finished (run the same command again): {names}", exit_code=1)
