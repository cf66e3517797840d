"""The findings of one file, up to a limit."""

from __future__ import annotations

from dslkit.diagnostics import Collector, Diagnostic
from rossmarie.syntax.limits import MAXIMUM_ERRORS


class LimitedFindings:
    """Passes findings on to a collector, each once, up to the limit of shown findings."""

    def __init__(self, collector: Collector) -> None:
        self._collector = collector
        self._seen: set[Diagnostic] = set()

    def add(self, finding: Diagnostic) -> None:
        """Pass on a finding. If the limit is reached, do nothing."""
        if not self.is_full and finding not in self._seen:
            self._seen.add(finding)
            self._collector.add(finding)

    @property
    def count(self) -> int:
        """The number of different findings."""
        return len(self._seen)

    @property
    def is_full(self) -> bool:
        """True if the limit is reached, so that further reading is useless."""
        return len(self._seen) > MAXIMUM_ERRORS
