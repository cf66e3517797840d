"""Functions that one package calls in another without importing it: by entry points.

The package with the function names it in its metadata (`[project.entry-points."ezskiros.check"]`).
"""

from __future__ import annotations

from collections.abc import Callable
from importlib.metadata import entry_points
from typing import Any


def extension(group: str, name: str) -> Callable[..., Any] | None:
    """The function of an installed package under a name; None if there is no such function or the
    package has been removed.
    """
    found = next(iter(entry_points(group=group, name=name)), None)
    if found is None:
        return None
    try:
        loaded: Callable[..., Any] = found.load()
    except ModuleNotFoundError as error:
        if error.name != found.module.partition(".")[0]:
            raise
        return None
    return loaded
