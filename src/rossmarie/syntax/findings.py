"""The findings of one file, up to a limit."""

from __future__ import annotations

from dslkit.diagnostics import Collector, Diagnostic
from dslkit.source import Span
from rossmarie.syntax import errors
from rossmarie.syntax.limits import MAXIMUM_ERRORS


class Findings:
    """Passes findings on to a collector, each once, until there are too many.

    The first one too many is replaced by a closing finding behind all others.
    """

    def __init__(self, collector: Collector) -> None:
        self._collector = collector
        self._seen: set[Diagnostic] = set()
        self._is_full = False

    def add(self, finding: Diagnostic) -> None:
        """Pass on a finding; nothing happens when there are too many already."""
        if self._is_full or finding in self._seen:
            return
        if len(self._seen) == MAXIMUM_ERRORS:
            self._is_full = True
            closing = errors.TooManyErrors(limit=MAXIMUM_ERRORS)
            end = max(seen.primary.span.end for seen in self._seen)
            self._collector.add(closing.at(Span(finding.primary.span.file, end, end)))
        else:
            self._seen.add(finding)
            self._collector.add(finding)

    @property
    def count(self) -> int:
        """How many different findings there are."""
        return len(self._seen)

    @property
    def is_full(self) -> bool:
        """Whether there are too many: reading on stops to be of use."""
        return self._is_full
