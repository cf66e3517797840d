"""The attributes of a description that `+=` adds to: conditions, permissions, uses."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Generic, TypeVar

from ezskiros import session
from ezskiros.ontology.symbols import UNKNOWN, UnknownValue
from ezskiros.skills import errors

Item = TypeVar("Item")


class Added(Generic[Item]):
    """The items of an attribute of a description."""

    def __init__(self, attribute: str) -> None:
        self._attribute = attribute
        self._items: list[Item] = []
        self.are_whole = True
        """True if all additions were valid. After a mistake, items may be missing."""

    def __getattr__(self, name: str) -> UnknownValue:
        if name.startswith("__"):
            raise AttributeError(name)
        self.are_whole = False
        found = errors.AddedOtherwise(spelled=name, conditions=self._attribute)
        session.report(found.at(session.here()))
        return UNKNOWN

    def __iter__(self) -> Iterator[Item]:
        return iter(self._items)
