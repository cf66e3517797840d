"""All names and literals that the generated Python takes from users.

The input is any text. Only the file and the functions of topics are named after users' texts. All
other names contain the index in the machine; a comment contains the user's words.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable
from pathlib import PurePath

from dslkit.source import Span

_LONGEST = 40


def identifier(text: str) -> str:
    """The text as a word of small letters, digits and underscores; never empty."""
    plain = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode("ascii")
    return re.sub(r"[^a-z0-9]+", "_", plain.lower()).strip("_")[:_LONGEST].strip("_") or "it"


def file_name(program: str) -> str:
    """The module of a program, with an importable name whatever the name of the rules file."""
    word = identifier(program)
    return f"{'n' if word[0].isdigit() else ''}{word}_monitor.py"


def different(prefix: str, texts: Iterable[str]) -> list[str]:
    """A unique identifier for each text, which resembles the text."""
    found: list[str] = []
    for text in texts:
        word = candidate = prefix + identifier(text)
        number = 1
        while candidate in found:
            number += 1
            candidate = f"{word}_{number}"
        found.append(candidate)
    return found


def place(span: Span) -> str:
    """`file.ross:12`, without folders, which differ from computer to computer."""
    return f"{PurePath(span.file.path).name}:{span.begin.line}"


def strings(texts: Iterable[str]) -> str:
    """A tuple of strings."""
    return tuple_of(ascii(text) for text in texts)


def tuple_of(parts: Iterable[str]) -> str:
    """A tuple of expressions."""
    listed = list(parts)
    return f"({listed[0]},)" if len(listed) == 1 else f"({', '.join(listed)})"
