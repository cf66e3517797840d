"""A source text and the conversion of its offsets to lines and columns.

Offsets count code points from 0. Lines and columns count from 1, as editors show them; this module
is the only place that converts.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property

_LINE_END = re.compile(r"\r\n?|\n")


@dataclass(frozen=True)
class Position:
    """A place in a file, counted from 1 (columns in code points)."""

    line: int
    column: int


@dataclass(frozen=True, eq=False)
class SourceFile:
    """One text that a user wrote; `path` is the name shown to the user, `mark` the byte order mark
    in front of it, if there is one.

    Compared by identity: the same text read twice is two files.
    """

    path: str
    text: str
    mark: str = ""

    @classmethod
    def decoded(cls, path: str, content: bytes) -> SourceFile:
        """The text of a file in UTF-8. Raises `UnicodeDecodeError`."""
        whole = content.decode("utf-8")
        text = whole.removeprefix("\ufeff")
        return cls(path, text, whole[: len(whole) - len(text)])

    @property
    def sha256(self) -> str:
        """The SHA-256 of the file as it was read, in hexadecimal."""
        import hashlib  # loads OpenSSL

        return hashlib.sha256((self.mark + self.text).encode()).hexdigest()

    @cached_property
    def line_starts(self) -> tuple[int, ...]:
        """The offset of each line start, as editors and Python count lines: a single carriage
        return ends a line as well.
        """
        return (0, *(end.end() for end in _LINE_END.finditer(self.text)))

    def position(self, offset: int) -> Position:
        """The line and column of an offset between 0 and the length of the text."""
        line = bisect_right(self.line_starts, offset)
        return Position(line, offset - self.line_starts[line - 1] + 1)

    def line_text(self, line: int) -> str:
        """The text of a line (counted from 1) without its line ending; empty past the end."""
        if line > len(self.line_starts):
            return ""
        start = self.line_starts[line - 1]
        is_last = line == len(self.line_starts)
        end = len(self.text) if is_last else self.line_starts[line]
        return self.text[start:end].rstrip("\r\n")
