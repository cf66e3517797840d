"""Methods that give one term for each index, however often they are asked: to build a term again
costs the solver's interface more than the solver.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar

_Term = TypeVar("_Term")


def once_each(method: Callable[[Any, int], _Term]) -> Callable[[Any, int], _Term]:
    """Call a method once for each index, and remember what it gave as long as its object lives."""
    memory = f"_{method.__name__}_of_each"

    @wraps(method)
    def remembered(self: Any, index: int) -> _Term:
        known: dict[int, _Term] = self.__dict__.setdefault(memory, {})
        if index not in known:
            known[index] = method(self, index)
        return known[index]

    return remembered
