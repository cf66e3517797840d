"""Files of Python, with the encoding and the line ends that they have."""

from __future__ import annotations

import re
import tokenize
from pathlib import Path

DEEPEST = 200
"""How deep brackets may lie in each other; Python itself takes no more."""
MOST_PREFIXES = 1000
"""How many operators may follow each other."""

_BRACKET = re.compile(r"([(\[{])|([)\]}])")
_PREFIXES = re.compile(rf"(?:(?:not\b|await\b|lambda\s*:|[-+~*])\s*){{{MOST_PREFIXES}}}")


def read_python(path: Path) -> tuple[str, str]:
    """The encoding of a file, and its text. Raises `OSError`, `SyntaxError`, `UnicodeError`."""
    with path.open("rb") as file:
        encoding, _ = tokenize.detect_encoding(file.readline)
    return encoding, path.read_bytes().decode(encoding)


def too_deep(text: str) -> int | None:
    """The offset from which on the parts of a text lie too deep in each other for a parser, which
    would end the process; None if they do not.

    Brackets in strings count as well: the text need not be of Python.
    """
    depth = 0
    for found in _BRACKET.finditer(text):
        depth = depth + 1 if found[1] else max(depth - 1, 0)
        if depth > DEEPEST:
            return found.start()
    prefixes = _PREFIXES.search(text)
    return prefixes.start() if prefixes else None
