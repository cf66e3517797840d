"""The command line of a benchmark: the path of the page that it writes."""

from __future__ import annotations

import argparse
from pathlib import Path


def written_page(description: str | None) -> Path:
    """The path of the page. Ends the program if the command line does not give one."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--out", type=Path, required=True, help="the page to write")
    out: Path = parser.parse_args().out
    return out
