"""Reports that commands write in addition to their output."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from rossmarie.cli.output import output


def refuse_report(report: Path, read: Sequence[Path]) -> None:
    """End the run early if the report would overwrite its own input."""
    if any(os.path.realpath(report) == os.path.realpath(each) for each in read):
        output.fail(f"{report} is an input file; choose another --out", exit_code=2)
