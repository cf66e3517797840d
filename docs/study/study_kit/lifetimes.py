"""Lifetimes of findings: when each came, when each vanished, and which came back.

A study log has no identity for a finding, because its line moves while a participant works. So a
lifetime belongs to a code in a file: when one more finding of the code is there than in the run
before, a lifetime begins, and when one less is there, the oldest lifetime ends. A run that does
not check a file says nothing of its findings.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any

Run = Mapping[str, Any]
Key = tuple[str, str]
"""A code and the name of a file."""


@dataclass(frozen=True)
class Lifetime:
    """One finding: its code, when it came and for how long it stayed, in seconds.

    `vanished` is false for a finding of the last run: its time is a lower bound. `came_back` says
    that a finding of the code had vanished from the file before.
    """

    code: str
    began: datetime
    seconds: float
    vanished: bool
    came_back: bool


def lifetimes(runs: Sequence[Run]) -> Sequence[Lifetime]:
    """All lifetimes in the runs of one study log, in the order in which they end."""
    began: dict[Key, list[tuple[datetime, bool]]] = defaultdict(list)
    has_vanished: set[Key] = set()
    found: list[Lifetime] = []
    now = None
    for run in runs:
        now = datetime.fromisoformat(run["time"])
        counts = Counter((each["code"], each["file"]) for each in run["findings"])
        files = {each["name"] for each in run["files"]} | {file for _, file in counts}
        for key in {*began, *counts}:
            if key[1] not in files:
                continue
            while len(began[key]) > counts[key]:
                found.append(_lifetime(key, began[key].pop(0), now, vanished=True))
                has_vanished.add(key)
            while len(began[key]) < counts[key]:
                began[key].append((now, key in has_vanished))
    for key, starts in began.items():
        found += [_lifetime(key, start, now or start[0], vanished=False) for start in starts]
    return found


def _lifetime(key: Key, start: tuple[datetime, bool], now: datetime, *, vanished: bool) -> Lifetime:
    began, came_back = start
    return Lifetime(key[0], began, (now - began).total_seconds(), vanished, came_back)
