"""Counts of how often something was so, and for how long."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field
from typing import Generic, TypeVar

Name = TypeVar("Name", bound=Hashable)


@dataclass
class Count:
    """The times that something was so, and the seconds in all."""

    times: int = 0
    seconds: float = 0.0


@dataclass
class Tally(Generic[Name]):
    """Counts by names. Of one name several may be so at a time: each has a key of its own."""

    counts: dict[str, Count] = field(default_factory=dict)
    since: dict[Name, tuple[str, float]] = field(default_factory=dict)

    def begin(self, key: Name, name: str, at: float) -> None:
        """Something begins to be so."""
        self.counts.setdefault(name, Count()).times += 1
        self.since[key] = name, at

    def end(self, key: Name, at: float) -> float:
        """It is so no longer; gives the seconds since it began."""
        name, begun = self.since.pop(key)
        lasted = max(0.0, at - begun)
        self.counts[name].seconds += lasted
        return lasted
