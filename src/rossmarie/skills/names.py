"""Names of classes and properties: `skiros.Product`, or `Product` if it is unique."""

from __future__ import annotations

from collections.abc import Iterable


def among(name: str, full_names: Iterable[str]) -> tuple[str, ...]:
    """The full names that a name may stand for: the name itself, else all full names that end with
    it.
    """
    names = tuple(full_names)
    return (name,) if name in names else tuple(n for n in names if n.endswith(f".{name}"))
