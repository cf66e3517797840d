"""The place in the user's code that is being executed: the innermost frame of the call stack
outside these packages.

The place is the exact expression: Python stores it for each instruction (PEP 657); before Python
3.11 the library `executing` finds it.
"""

from __future__ import annotations

import ast
import linecache
import os
import sys
from functools import lru_cache
from pathlib import Path
from types import CodeType, FrameType, TracebackType

from dslkit.source.file import SourceFile
from dslkit.source.paths import ending, shown
from dslkit.source.span import Span

_OURS = f"{Path(__file__).parents[1]}{os.sep}"


def call_site(*ours: str, but: tuple[str, ...] = ()) -> Span | None:
    """The expression in the user's code that led here; None if no such frame has a source.

    Frames of files in one of the folders `ours`, and of this package, are skipped. Files whose
    paths begin with `but` still count as the user's.
    """
    passed = (_OURS, *ours, "<frozen")
    frame: FrameType | None = sys._getframe(1)  # noqa: SLF001
    while frame is not None:
        path = frame.f_code.co_filename
        if path.startswith(but) or not path.startswith(passed):
            return place_of(frame)
        frame = frame.f_back
    return None


def place_of(where: FrameType | TracebackType) -> Span | None:
    """The expression that a frame executes, or executed when an exception left it.

    If the expression is unknown, the whole line; None if there is no source.
    """
    frame = where.tb_frame if isinstance(where, TracebackType) else where
    line = where.tb_lineno if isinstance(where, TracebackType) else where.f_lineno
    file = source_file(frame.f_code.co_filename)
    return None if file is None else _expression(file, where) or line_span(file, line)


@lru_cache(maxsize=4096)
def source_file(path: str) -> SourceFile | None:
    """The text of a module, decoded as Python does; None if there is no such Python file."""
    lines = linecache.getlines(path) if ending(Path(path)) == ".py" else []
    return SourceFile(shown(path), "".join(lines)) if lines else None


def node_span(file: SourceFile, node: ast.AST) -> Span:
    """The text of a node of the syntax tree of a file."""
    begin = _offset(file, getattr(node, "lineno", 1), getattr(node, "col_offset", 0))
    end = _offset(file, getattr(node, "end_lineno", 1), getattr(node, "end_col_offset", 0))
    return Span(file, begin, end)


if sys.version_info < (3, 11):

    def _expression(file: SourceFile, where: FrameType | TracebackType) -> Span | None:
        import executing

        node = executing.Source.executing(where).node
        return None if node is None else node_span(file, node)

else:

    def _expression(file: SourceFile, where: FrameType | TracebackType) -> Span | None:
        if isinstance(where, TracebackType):
            return _at(file, where.tb_frame.f_code, where.tb_lasti)
        return _at(file, where.f_code, where.f_lasti)

    def _at(file: SourceFile, code: CodeType, instruction: int) -> Span | None:
        table = _positions(code)
        found = table[instruction // 2] if instruction // 2 < len(table) else (None,)
        if None in found:
            return None
        first, last, begin, end = (number or 0 for number in found)
        return Span(file, _offset(file, first, begin), _offset(file, last, end))

    @lru_cache(maxsize=64)
    def _positions(code: CodeType) -> list[tuple[int | None, ...]]:
        """The position of each instruction: first and last line, counted from 1, begin and end
        column in bytes.
        """
        return list(code.co_positions())


def _offset(file: SourceFile, line: int, byte: int) -> int:
    """The offset in code points for a column that counts UTF-8 bytes."""
    start = file.line_starts[line - 1]
    if file.text.isascii():
        return min(start + byte, len(file.text))
    return start + len(file.line_text(line).encode()[:byte].decode("utf-8", "ignore"))


def line_span(file: SourceFile, line: int) -> Span:
    """A line without its indentation and its comment-free end."""
    line = min(max(line, 1), len(file.line_starts))
    text = file.line_text(line)
    start = file.line_starts[line - 1]
    return Span(file, start + len(text) - len(text.lstrip()), start + len(text.rstrip()))
