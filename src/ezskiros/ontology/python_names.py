"""The Python names of entities of an ontology."""

from __future__ import annotations

import keyword
from collections.abc import Iterable


def identifier(name: str) -> str:
    """A valid Python name: `Large-Box` becomes `Large_Box`, `class` becomes `class_`, `3D` becomes
    `_3D`.
    """
    found = name
    if not name.isidentifier():
        found = "".join(each if f"_{each}".isidentifier() else "_" for each in name)
    if not found.isidentifier():
        found = f"_{found}"
    return f"{found}_" if keyword.iskeyword(found) else found


def identifiers(names: Iterable[str]) -> dict[str, str]:
    """Names by identifier. If several names have the same identifier, the name that equals it gets
    it, otherwise the first in alphabetical order; the others get trailing underscores.
    """
    found: dict[str, str] = {}
    for name in sorted(names, key=lambda name: (identifier(name) != name, name)):
        spelling = identifier(name)
        while spelling in found:
            spelling += "_"
        found[spelling] = name
    return found
