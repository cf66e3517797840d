"""Lessons as data: costs of skills at places, rules that they tripped, and their failures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

Places: TypeAlias = tuple[tuple[str, str], ...]
"""Parameters and the IRIs of the locations that they stood for, sorted."""


@dataclass(frozen=True)
class Share:
    """Some of `all` runs."""

    runs: int
    all: int

    def __str__(self) -> str:
        return f"{self.runs} of {self.all} run{'s' if self.all != 1 else ''}"


@dataclass(frozen=True)
class Cost:
    """One skill with some places: how often it ran, how often a rule became active meanwhile, and
    for how many seconds such rules stayed active.
    """

    skill: str
    places: Places
    executions: int
    activations: int
    lost_s: float

    @property
    def expected_s(self) -> float:
        """The seconds that one more execution is expected to lose."""
        return self.lost_s / self.executions if self.executions else 0.0


@dataclass(frozen=True)
class Trip:
    """One rule, and the skill that ran innermost when it became active: None if none ran.

    `share` is of the runs of the skill that the rule watched; `at` has those with each of its
    places or none, `within` the activations by the skills right above it, and `evidence` the cause
    of the first one.
    """

    rule: str
    skill: str | None
    share: Share
    activations: int
    lost_s: float
    within: Mapping[str, int]
    at: Mapping[Places, Share]
    evidence: str


@dataclass(frozen=True)
class Failure:
    """One skill that failed in some of the runs in which it was started, and most often why. A
    skill that failed because one below it did is not counted.
    """

    skill: str
    share: Share
    reason: str


@dataclass(frozen=True)
class Stale:
    """A rule that became active in some runs for lack of an input."""

    rule: str
    share: Share


@dataclass(frozen=True)
class Lessons:
    """All that some runs teach."""

    runs: int
    trips: Sequence[Trip]
    failures: Sequence[Failure]
    costs: Sequence[Cost]
    stale: Sequence[Stale]
