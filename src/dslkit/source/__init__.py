"""Where a thing was written: files and spans."""

from dslkit.source.file import Position, SourceFile
from dslkit.source.span import Span

__all__ = ["Position", "SourceFile", "Span"]
