"""Reports that commands write beside what they print."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from rossmarie.cli.output import output


def refuse_report(report: Path, read: Sequence[Path]) -> None:
    """End the run, before it takes its time, if the report would replace what it is about."""
    if any(os.path.realpath(report) == os.path.realpath(each) for each in read):
        output.fail(f"{report} is what is read; choose another --out", exit_code=2)
