"""The versions of rdflib with which SkiROS2 works, measured on its branch for ROS 1."""

from __future__ import annotations

import re
from importlib import metadata

_FIRST, _BEYOND = (6, 2), (7, 0)


def unfit() -> str | None:
    """The reason why SkiROS2 does not work with the installed rdflib; None if it works or rdflib is
    not installed.
    """
    try:
        found = metadata.version("rdflib")
    except metadata.PackageNotFoundError:
        return None
    version = tuple(map(int, re.findall(r"\d+", found)[:2]))
    if _FIRST <= version < _BEYOND:
        return None
    is_old = version < _FIRST
    fault = "finds no relations of individuals" if is_old else "cannot load its ontologies"
    return f'SkiROS2 {fault} with rdflib {found}: pip install "rdflib>=6.2,<7"'
