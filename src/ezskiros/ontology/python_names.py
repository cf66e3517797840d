"""The names of things of an ontology in Python."""

from __future__ import annotations

import keyword
from collections.abc import Iterable


def identifier(name: str) -> str:
    """A name that Python takes: `Large-Box` is `Large_Box`, `class` is `class_`, `3D` is `_3D`."""
    found = name
    if not name.isidentifier():
        found = "".join(each if f"_{each}".isidentifier() else "_" for each in name)
    if not found.isidentifier():
        found = f"_{found}"
    return f"{found}_" if keyword.iskeyword(found) else found


def identifiers(names: Iterable[str]) -> dict[str, str]:
    """Names by their identifiers. Of names that would be called the same, the first in alphabetical
    order gets the identifier, unless one of them is it already; others get underscores behind it.
    """
    found: dict[str, str] = {}
    for name in sorted(names, key=lambda name: (identifier(name) != name, name)):
        spelling = identifier(name)
        while spelling in found:
            spelling += "_"
        found[spelling] = name
    return found
