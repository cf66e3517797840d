"""Files of Python, with the encoding and the line ends that they have."""

from __future__ import annotations

import tokenize
from pathlib import Path


def read_python(path: Path) -> tuple[str, str]:
    """The encoding of a file, and its text. Raises `OSError`, `SyntaxError`, `UnicodeError`."""
    with path.open("rb") as file:
        encoding, _ = tokenize.detect_encoding(file.readline)
    return encoding, path.read_bytes().decode(encoding)
