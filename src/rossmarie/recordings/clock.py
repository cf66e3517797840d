"""Clocks that were set back during a recording.

Stored messages are replayed in the order of their stamps. If the clock was set back (a restarted
simulation, a corrected clock), two periods overlap; the order in which the messages were stored
shows this. Rows of a CSV file are replayed in file order, so the monitor sees the clock go back.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from dslkit.diagnostics import Diagnostic
from rossmarie.recordings.errors import ClockSetBack, at_file

TOLERANCE_NS = 1_000_000_000
"""The longest delay between the stamp of a message and its storage. Recorders write in several
threads and from caches.
"""

Stamps: TypeAlias = "NDArray[np.int64] | NDArray[np.object_]"
"""Instants in nanoseconds; objects if an instant exceeds 64 bits."""

Arrivals: TypeAlias = tuple[str, Stamps]
"""Messages on a topic that were stored in succession."""

_MOST_AT_ONCE = 10_000

_MIXED = (
    "messages are replayed in the order of their stamps, so messages from before and after the "
    "jump are mixed: near the jump, the verdicts differ from the verdicts of the robot"
)
SEEN_BY_THE_MONITOR = (
    "rows are replayed in the order of the file: when the time goes back, the monitor reports a "
    "jump and restarts all durations"
)


def by_topic(arrivals: Iterable[tuple[str, int]]) -> Iterator[Arrivals]:
    """The topics and stamps of single messages, in their order, with successive messages of a topic
    joined.
    """
    remaining = iter(arrivals)
    while some := list(islice(remaining, _MOST_AT_ONCE)):
        stamps: dict[str, list[int]] = {}
        for topic, at_ns in some:
            stamps.setdefault(topic, []).append(at_ns)
        for topic, found in stamps.items():
            yield topic, stamps_of(found)


def stamps_of(instants_ns: Sequence[int]) -> Stamps:
    """Instants in ns as stamps."""
    try:
        return np.array(instants_ns, np.int64)
    except OverflowError:
        return np.array(instants_ns, np.object_)


class Setbacks:
    """Counts how often the stamps of a topic go back by more than `tolerance_ns`."""

    def __init__(self, tolerance_ns: int) -> None:
        self._tolerance_ns = tolerance_ns
        self._last_ns: dict[str, int] = {}
        self._counts: Counter[str] = Counter()
        self._farthest_ns = 0

    def note(self, topic: str, stamps_ns: Stamps) -> None:
        """Note the next stamps of a topic: one or more."""
        back_ns = -np.diff(stamps_ns, prepend=self._last_ns.get(topic, stamps_ns[0]))
        self._last_ns[topic] = stamps_ns[-1]
        if len(far := back_ns[back_ns > self._tolerance_ns]):
            self._counts[topic] += len(far)
            self._farthest_ns = max(self._farthest_ns, int(far.max()))

    def findings(self, effect: str, path: Path) -> tuple[Diagnostic, ...]:
        """A finding if any stamps go back: `effect` is their effect on a replay."""
        if not self._counts:
            return ()
        count = max(self._counts.values())
        often = "once" if count == 1 else f"{count} times"
        found = ClockSetBack(often=often, length=_length(self._farthest_ns), effect=effect)
        return (at_file(found, path),)


def _length(duration_ns: int) -> str:
    return f"{duration_ns / 1e9:.1f} s" if duration_ns >= 10**8 else f"{duration_ns / 1e6:g} ms"


def find_setbacks(arrivals: Iterable[Arrivals], path: Path) -> tuple[Diagnostic, ...]:
    """A finding if the stamps of a topic go back by more than `TOLERANCE_NS`.

    Stamps are compared topic by topic, because a converter may have stored one topic after the
    other.
    """
    setbacks = Setbacks(TOLERANCE_NS)
    for topic, stamps_ns in arrivals:
        setbacks.note(topic, stamps_ns)
    return setbacks.findings(_MIXED, path)
