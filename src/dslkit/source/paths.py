"""Queries about paths, and the way to show them. Unlike the methods of `Path`, these never raise:
a text that no path can be (too long, a NUL in it) leads nowhere.
"""

from __future__ import annotations

import os
from pathlib import Path


def is_file(path: Path) -> bool:
    """Say whether there is such a file."""
    return os.path.isfile(path)  # noqa: PTH113


def is_folder(path: Path) -> bool:
    """Say whether there is such a folder."""
    return os.path.isdir(path)  # noqa: PTH112


def ending(path: Path) -> str:
    """The ending of a file name, in lower case and with the dot. A link has the ending of the file
    that it leads to: the name of a link promises nothing.
    """
    try:
        return Path(os.path.realpath(path)).suffix.lower()
    except (OSError, ValueError):
        return path.suffix.lower()


def shown(path: str) -> str:
    """A path as people read it: from the current folder if it is in it."""
    return path.removeprefix(f"{Path.cwd()}{os.sep}")
