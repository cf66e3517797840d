"""A range of one source file."""

from __future__ import annotations

from dataclasses import dataclass

from dslkit.source.file import Position, SourceFile


@dataclass(frozen=True)
class Span:
    """A half-open range of offsets `[start, end)` in `file`."""

    file: SourceFile
    start: int
    end: int

    @property
    def text(self) -> str:
        """The text that the user wrote there."""
        return self.file.text[self.start : self.end]

    @property
    def begin(self) -> Position:
        """The position of the first character."""
        return self.file.position(self.start)

    @property
    def finish(self) -> Position:
        """The position just after the last character."""
        return self.file.position(self.end)

    def to(self, other: Span) -> Span:
        """The smallest span that covers both. They must be in the same file."""
        return Span(self.file, min(self.start, other.start), max(self.end, other.end))

    def contains(self, other: Span) -> bool:
        """Say whether the other span lies inside this one."""
        return self.file is other.file and self.start <= other.start and other.end <= self.end

    def __str__(self) -> str:
        return f"{self.file.path}:{self.begin.line}:{self.begin.column}"
