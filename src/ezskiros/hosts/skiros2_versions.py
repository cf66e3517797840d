"""The versions of rdflib with which SkiROS2 works, measured on its branch for ROS 1."""

from __future__ import annotations

from importlib import metadata

from packaging.specifiers import SpecifierSet
from packaging.version import Version

_RDFLIB = SpecifierSet(">=6.2,<7")


def unfit() -> str | None:
    """Why SkiROS2 does not work with the rdflib of this Python; None if it does, or has none."""
    try:
        found = metadata.version("rdflib")
    except metadata.PackageNotFoundError:
        return None
    if found in _RDFLIB:
        return None
    is_old = Version(found) < Version("6.2")
    fault = "finds no relations of things" if is_old else "cannot load its ontologies"
    return f'SkiROS2 {fault} with rdflib {found}: pip install "rdflib>=6.2,<7"'
