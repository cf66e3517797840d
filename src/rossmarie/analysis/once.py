"""Methods that build one term per index and reuse it, because building a term again costs more than
solving it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar

_Term = TypeVar("_Term")


def once_each(method: Callable[[Any, int], _Term]) -> Callable[[Any, int], _Term]:
    """Decorate a method so that it runs once for each index. The result exists as long as its
    object.
    """
    memory = f"_{method.__name__}_of_each"

    @wraps(method)
    def remembered(self: Any, index: int) -> _Term:
        known: dict[int, _Term] = self.__dict__.setdefault(memory, {})
        if index not in known:
            known[index] = method(self, index)
        return known[index]

    return remembered
