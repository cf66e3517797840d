"""What is fuzzed: the whole check of a file, and all that is said about it."""

from __future__ import annotations

import time
from pathlib import Path

from dslkit.diagnostics.render_json import render_json
from dslkit.diagnostics.render_sarif import render_sarif
from dslkit.diagnostics.render_text import render_text
from rossmarie.catalog import CATALOG
from rossmarie.driver import check_file
from rossmarie.lowering import lower

CPU_LIMIT_S = 30.0
"""The largest files take 3 s of a quiet machine."""
TOOL = CATALOG.sarif_tool("0")


class TooSlowError(Exception):
    """A check took longer than any file of its size may take."""


def check_bytes(content: bytes, folder: Path) -> None:
    """Check a rules file with this content, lower it if it is free of errors, print the findings.

    Raises whatever escapes from the check, and `TooSlowError`.
    """
    path = folder / "fuzzed.ross"
    path.write_bytes(content)
    begin = time.process_time()
    result = check_file(path)
    if result.program is not None:
        lower(result.program)
    render_text(result.diagnostics).plain.encode()
    render_json(result.diagnostics, file_count=1)
    render_sarif(result.diagnostics, TOOL)
    taken = time.process_time() - begin
    if taken > CPU_LIMIT_S:
        raise TooSlowError(f"{taken:.1f} s of CPU for {len(content)} bytes")
