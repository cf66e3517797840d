"""The run of a campaign: episodes in the journal are not run again, and new results are appended to
it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from typing import Protocol

from dslkit.campaign.journal import Journal
from dslkit.campaign.workers import EpisodeResult, Value, Work, Workers


@dataclass(frozen=True)
class FailedEpisode:
    """An episode that did not finish. The journal does not contain it, so a later run tries it
    again.
    """

    key: str
    reason: str


@dataclass(frozen=True)
class Campaign:
    """The outcome: rows by key, in the order of the keys."""

    values: Mapping[str, Value]
    failures: tuple[FailedEpisode, ...]


class Witness(Protocol):
    """An observer of progress."""

    def begin(self, count: int, done: int) -> None:
        """Begin with `count` episodes, of which `done` were in the journal."""

    def hear(self, result: EpisodeResult) -> None:
        """Take one more result."""


def run(
    keys: Sequence[str], work: Work, journal: Journal, workers: Workers, witness: Witness
) -> Campaign:
    """Run the episodes of all keys that are not in the journal."""
    missing = [key for key in dict.fromkeys(keys) if key not in journal.values]
    witness.begin(len(set(keys)), len(set(keys)) - len(missing))
    failures = []
    with closing(workers.results(work, missing)) as results:
        for result in results:
            if result.value is None:
                failures.append(FailedEpisode(result.key, result.failure))
            else:
                journal.append(result.key, result.value)
            witness.hear(result)
    values = {key: journal.values[key] for key in keys if key in journal.values}
    return Campaign(values, tuple(failures))
