"""Lessons as data: costs of skills at places, the rules that became active, and failures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

Places: TypeAlias = tuple[tuple[str, str], ...]
"""Parameters and the IRIs of their locations, sorted."""


@dataclass(frozen=True)
class Share:
    """A number of runs, of `all` runs."""

    runs: int
    all: int

    def __str__(self) -> str:
        return f"{self.runs} of {self.all} run{'s' if self.all != 1 else ''}"


@dataclass(frozen=True)
class Cost:
    """One skill with some places: the number of its executions, the number of activations during
    them, and the seconds for which the rules stayed active.
    """

    skill: str
    places: Places
    executions: int
    activations: int
    lost_s: float

    @property
    def expected_s(self) -> float:
        """The expected loss of one more execution in seconds."""
        return self.lost_s / self.executions if self.executions else 0.0


@dataclass(frozen=True)
class Trip:
    """One rule, and the innermost running skill when the rule became active; None if no skill ran.

    `share` counts the runs of the skill that the rule monitored. `at` counts the runs with each
    place, or with none. `within` counts the activations by the parents of the skill. `evidence` is
    the cause of the first activation.
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
class SkillFailure:
    """One skill that failed in some of its runs, with the most frequent reason. Failures because of
    a child are not counted.
    """

    skill: str
    share: Share
    reason: str


@dataclass(frozen=True)
class Stale:
    """A rule that became active in some runs because of a stale input."""

    rule: str
    share: Share


@dataclass(frozen=True)
class Lessons:
    """All lessons of some runs."""

    runs: int
    trips: Sequence[Trip]
    failures: Sequence[SkillFailure]
    costs: Sequence[Cost]
    stale: Sequence[Stale]
