"""Source files, and spans of them."""

from dslkit.source.file import Position, SourceFile
from dslkit.source.paths import ending, is_file, is_folder, shown
from dslkit.source.span import Span

__all__ = ["Position", "SourceFile", "Span", "ending", "is_file", "is_folder", "shown"]
