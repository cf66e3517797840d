"""Who runs episodes: what all kinds of workers have in common."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from typing import Protocol

Scalar = str | float | bool | None
Value = dict[str, Scalar]
"""The outcome of an episode: one row, as JSON has it."""

Work = Callable[[str], Value]
"""Runs the episode of a key. To be found by its name in other processes."""


class UnreachableError(Exception):
    """Those who were to run the episodes are not there."""


@dataclass(frozen=True)
class Result:
    """The end of an episode: its row, or the reason why there is none."""

    key: str
    value: Value | None
    failure: str = ""


class Workers(Protocol):
    """Processes, on this machine or elsewhere."""

    def results(self, work: Work, keys: Sequence[str]) -> Generator[Result, None, None]:
        """One result for each key, as they come. Closing it ends all that still run."""
