"""Counts of states: the number of times that each was entered, and the total duration."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field
from typing import Generic, TypeVar

Name = TypeVar("Name", bound=Hashable)


@dataclass
class StateCount:
    """The number of times that a state was entered, and the total seconds."""

    times: int = 0
    seconds: float = 0.0


@dataclass
class Tally(Generic[Name]):
    """Counts by name. Several instances of one name may be active at a time: each has its own
    key.
    """

    counts: dict[str, StateCount] = field(default_factory=dict)
    since: dict[Name, tuple[str, float]] = field(default_factory=dict)

    def begin(self, key: Name, name: str, at: float) -> None:
        """A state begins."""
        self.counts.setdefault(name, StateCount()).times += 1
        self.since[key] = name, at

    def end(self, key: Name, at: float) -> float:
        """A state ends. Returns the seconds since it began."""
        name, begun = self.since.pop(key)
        lasted = max(0.0, at - begun)
        self.counts[name].seconds += lasted
        return lasted
