"""The number of findings, in words."""

from __future__ import annotations

from collections.abc import Iterable

from dslkit.diagnostics.model import Diagnostic, Severity


def count(diagnostics: Iterable[Diagnostic], severity: Severity) -> int:
    """The number of findings of this severity."""
    return sum(found.severity is severity for found in diagnostics)


def summary(diagnostics: Iterable[Diagnostic], file_count: int) -> str:
    """The last line of a check: `2 errors, 1 warning in 3 files`."""
    found = tuple(diagnostics)
    numbers = {severity: count(found, severity) for severity in Severity}
    parts = [_plural(number, severity.value) for severity, number in numbers.items() if number]
    return f"{', '.join(parts) or 'no errors'} in {_plural(file_count, 'file')}"


def _plural(number: int, word: str) -> str:
    return f"{number} {word}" if number == 1 else f"{number} {word}s"
