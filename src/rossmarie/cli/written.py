"""The output lines for written files."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from rossmarie.targets.copies import SUMS


def lines_of_written(paths: Sequence[Path]) -> Iterator[str]:
    """A line for each written file, and one line for each folder of files that are the same for all
    rules.
    """
    folders = [path.parent for path in paths if path.name == SUMS]
    for path in paths:
        if not any(path.is_relative_to(folder) for folder in folders):
            yield f"wrote {path}"
    for folder in folders:
        count = sum(1 for path in paths if path.is_relative_to(folder))
        yield f"wrote {folder}: {count} files that are the same for all rules"
