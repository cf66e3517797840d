"""Queries about paths, and their display. Unlike the methods of `Path`, these never raise: an
impossible path (too long, with a NUL) does not exist.
"""

from __future__ import annotations

import os
from pathlib import Path


def is_file(path: Path) -> bool:
    """Say whether the file exists."""
    return os.path.isfile(path)  # noqa: PTH113


def is_folder(path: Path) -> bool:
    """Say whether the folder exists."""
    return os.path.isdir(path)  # noqa: PTH112


def ending(path: Path) -> str:
    """The ending of a file name, in lower case and with the dot. A link has the ending of its
    target, because the name of a link proves nothing.
    """
    try:
        return Path(os.path.realpath(path)).suffix.lower()
    except (OSError, ValueError):
        return path.suffix.lower()


def shown(path: str) -> str:
    """A path for display: relative to the current folder if it is inside."""
    return path.removeprefix(f"{Path.cwd()}{os.sep}")
