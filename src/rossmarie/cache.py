"""The folder for what can be made again: compiled monitors, the tables of the parser."""

from __future__ import annotations

import os
from pathlib import Path


def cache_folder() -> Path:
    """`$XDG_CACHE_HOME/rossmarie`, or `~/.cache/rossmarie`; it need not exist.

    Raises `OSError` if there is no home directory.
    """
    named = os.environ.get("XDG_CACHE_HOME")
    try:
        base = Path(named) if named else Path.home() / ".cache"
    except RuntimeError as error:
        raise OSError(f"no folder for what is kept: {error}") from error
    return base / "rossmarie"
