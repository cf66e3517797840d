"""Python files, with their encoding and line ends."""

from __future__ import annotations

import ast
import re
import tokenize
import warnings
from pathlib import Path

from dslkit.source.call_site import line_span
from dslkit.source.file import SourceFile
from dslkit.source.span import Span

DEEPEST = 200
"""The greatest depth of nested brackets; Python itself accepts no more."""
MOST_PREFIXES = 1000
"""The greatest number of adjacent prefix operators."""

_BRACKET = re.compile(r"([(\[{])|([)\]}])")
_PREFIXES = re.compile(rf"(?:(?:not\b|await\b|lambda\s*:|[-+~*])\s*){{{MOST_PREFIXES}}}")


def read_python(path: Path) -> tuple[str, str]:
    """The encoding of a file, and its text. Raises `OSError`, `SyntaxError`, `UnicodeError`."""
    with path.open("rb") as file:
        encoding, _ = tokenize.detect_encoding(file.readline)
    return encoding, path.read_bytes().decode(encoding)


def refusal(file: SourceFile) -> tuple[str, Span] | None:
    """The reason why Python rejects the text of a file, and the place; None if it accepts it.

    Other parsers accept some texts that Python rejects: null bytes, and invalid escapes in strings.
    """
    nothing = file.text.find("\0")
    if nothing >= 0:
        return "a byte is 0", Span(file, nothing, nothing + 1)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            ast.parse(file.text)
    except SyntaxError as problem:
        line = min(max(problem.lineno or 1, 1), len(file.line_starts))
        return problem.msg, line_span(file, line)
    except (ValueError, RecursionError, MemoryError) as problem:
        return str(problem) or type(problem).__name__, Span(file, 0, 0)
    return None


def too_deep(text: str) -> int | None:
    """The offset at which a text is nested so deeply that a parser would end the process; None if
    no place is.

    Brackets in strings count as well, because the text need not be Python.
    """
    depth = 0
    for found in _BRACKET.finditer(text):
        depth = depth + 1 if found[1] else max(depth - 1, 0)
        if depth > DEEPEST:
            return found.start()
    prefixes = _PREFIXES.search(text)
    return prefixes.start() if prefixes else None
