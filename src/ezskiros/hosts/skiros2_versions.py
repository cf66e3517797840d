"""The versions of rdflib with which SkiROS2 works, measured on its branch for ROS 1."""

from __future__ import annotations

import re
from importlib import metadata

_FIRST, _BEYOND = (6, 2), (7, 0)


def unfit() -> str | None:
    """Why SkiROS2 does not work with the rdflib of this Python; None if it does, or has none."""
    try:
        found = metadata.version("rdflib")
    except metadata.PackageNotFoundError:
        return None
    version = tuple(map(int, re.findall(r"\d+", found)[:2]))
    if _FIRST <= version < _BEYOND:
        return None
    is_old = version < _FIRST
    fault = "finds no relations of things" if is_old else "cannot load its ontologies"
    return f'SkiROS2 {fault} with rdflib {found}: pip install "rdflib>=6.2,<7"'
