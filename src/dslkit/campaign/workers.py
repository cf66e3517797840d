"""Workers, which run episodes: the interface of all kinds of workers."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from typing import Protocol

Scalar = str | float | bool | None
Value = dict[str, Scalar]
"""The result of an episode: one row, in the types of JSON."""

Work = Callable[[str], Value]
"""A function that runs the episode of a key. Other processes must be able to import it by name."""


class UnreachableError(Exception):
    """The workers cannot be reached."""


@dataclass(frozen=True)
class EpisodeResult:
    """The end of an episode: its row, or the reason why there is no row."""

    key: str
    value: Value | None
    failure: str = ""


class Workers(Protocol):
    """Processes, on this machine or elsewhere."""

    def results(self, work: Work, keys: Sequence[str]) -> Generator[EpisodeResult, None, None]:
        """Yield one result for each key, in the order of completion. Closing the generator ends all
        running episodes.
        """
