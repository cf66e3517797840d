"""Reports that commands write where the user says."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from dslkit.writing import reason, try_writing, write_whole
from rossmarie.cli.output import output


def save(path: Path, text: str) -> None:
    """Write a file; the run ends if that cannot be done."""
    try:
        write_whole(path, text)
    except OSError as error:
        output.fail(f"cannot write {path}: {reason(error)}", exit_code=2)


def refuse_report(report: Path, read: Sequence[Path]) -> None:
    """End the run, before it takes its time, if the report could not be written after it, or would
    replace something that it is about.
    """
    if any(os.path.realpath(report) == os.path.realpath(each) for each in read):
        output.fail(f"{report} is what is read; choose another --json", exit_code=2)
    try:
        try_writing(report)
    except OSError as error:
        output.fail(f"cannot write {report}: {reason(error)}", exit_code=2)
