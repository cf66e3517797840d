"""Clocks that were set back while a recording was made.

Stored messages are replayed in the order of their stamps. Where the clock was set back (a
simulation that was started again, a clock that was corrected), two stretches of time lie over each
other then; that shows in the order in which the messages were stored. Rows of a CSV file are
replayed as they stand, so that there the monitor sees the clock go back.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from pathlib import Path

from dslkit.diagnostics import Diagnostic
from rossmarie.recordings.errors import ClockSetBack, at_file

TOLERANCE_NS = 1_000_000_000
"""How late a message may be stored: recorders write in several threads, and from caches."""

Arrival = tuple[str, int]
"""The topic and the stamp of a message, in nanoseconds."""

_MIXED = (
    "messages are replayed in the order of their stamps, so that those from before and after "
    "are mixed: verdicts around there are not those of the robot"
)
SEEN_BY_THE_MONITOR = (
    "rows are replayed in the order of the file: where the time goes back, the monitor reports a "
    "jump and measures all durations anew"
)


class Setbacks:
    """Counts how often the stamps of a topic go back by more than `tolerance_ns`."""

    def __init__(self, tolerance_ns: int) -> None:
        self._tolerance_ns = tolerance_ns
        self._last_ns: dict[str, int] = {}
        self._counts: Counter[str] = Counter()
        self._farthest_ns = 0

    def note(self, topic: str, at_ns: int) -> None:
        """The next stamp of a topic."""
        back_ns = self._last_ns.get(topic, at_ns) - at_ns
        self._last_ns[topic] = at_ns
        if back_ns > self._tolerance_ns:
            self._counts[topic] += 1
            self._farthest_ns = max(self._farthest_ns, back_ns)

    def findings(self, effect: str, path: Path) -> tuple[Diagnostic, ...]:
        """A finding if there are any: `effect` is what they do to a replay."""
        if not self._counts:
            return ()
        count = max(self._counts.values())
        often = "once" if count == 1 else f"{count} times"
        found = ClockSetBack(often=often, length=_length(self._farthest_ns), effect=effect)
        return (at_file(found, path),)


def _length(duration_ns: int) -> str:
    return f"{duration_ns / 1e9:.1f} s" if duration_ns >= 10**8 else f"{duration_ns / 1e6:g} ms"


def find_setbacks(arrivals: Iterable[Arrival], path: Path) -> tuple[Diagnostic, ...]:
    """A finding if the stamps of a topic go back by more than `TOLERANCE_NS`.

    `arrivals` come in the order of storage. They are compared topic by topic, because a converter
    may have stored one topic after the other.
    """
    setbacks = Setbacks(TOLERANCE_NS)
    for topic, at_ns in arrivals:
        setbacks.note(topic, at_ns)
    return setbacks.findings(_MIXED, path)
