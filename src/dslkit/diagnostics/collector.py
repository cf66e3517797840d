"""The collector of the findings of all stages of a compiler."""

from __future__ import annotations

from collections.abc import Iterable

from dslkit.diagnostics.model import Diagnostic, Severity


class Collector:
    """Collects diagnostics; each distinct one is kept once."""

    def __init__(self) -> None:
        self._found: dict[Diagnostic, None] = {}

    def add(self, diagnostic: Diagnostic) -> None:
        """Store a finding."""
        self._found.setdefault(diagnostic)

    def extend(self, diagnostics: Iterable[Diagnostic]) -> None:
        """Store several findings."""
        for diagnostic in diagnostics:
            self.add(diagnostic)

    @property
    def has_errors(self) -> bool:
        """Say whether the compiler has to stop before its next stage."""
        return any(found.severity is Severity.ERROR for found in self._found)

    def sorted(self) -> tuple[Diagnostic, ...]:
        """All findings, in the order in which their files appeared first, and sorted by place
        within each file.
        """
        files: dict[int, int] = {}
        for found in self._found:
            files.setdefault(id(found.primary.span.file), len(files))
        return tuple(sorted(self._found, key=lambda found: _place(found, files)))


def _place(found: Diagnostic, files: dict[int, int]) -> tuple[int, int, int, str]:
    span = found.primary.span
    return (files[id(span.file)], span.start, span.end, found.code)
