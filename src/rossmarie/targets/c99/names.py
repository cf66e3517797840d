"""All names that the generated C introduces.

The input is any text; the results are identifiers that are unique within their family, readable,
and not reserved in C or C++.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import PurePath

from dslkit.source import Span
from rossmarie.naming import c_identifier


class Family:
    """Identifiers that must be distinct, all with one prefix. They are in capitals if the prefix
    is. A name in capitals is a constant, and differs from all other names.
    """

    def __init__(self, prefix: str = "", taken: Iterable[str] = ()) -> None:
        self._prefix = prefix
        self._given = set(taken)
        self._numbers: dict[str, int] = {}

    def name(self, text: str, *endings: str) -> str:
        """A new identifier that resembles the text. It is also unique with each of the endings."""
        word = self._prefix + c_identifier(text)
        if self._prefix.isupper():
            word = word.upper()
        candidate = word
        while self._given.intersection(candidate + ending for ending in ("", *endings)):
            self._numbers[word] = self._numbers.get(word, 1) + 1
            candidate = f"{word}_{self._numbers[word]}"
        self._given.update(candidate + ending for ending in ("", *endings))
        return candidate


def place(span: Span) -> str:
    """`file.ross:12`, without folders, which differ from computer to computer."""
    return f"{PurePath(span.file.path).name}:{span.begin.line}"


def string(text: str) -> str:
    """The text as a string literal, in UTF-8. Bytes of a file name that are not valid text are
    escaped.
    """
    escaped = []
    for byte in text.encode("utf-8", "backslashreplace"):
        letter = chr(byte)
        is_plain = 32 <= byte < 127 and letter not in '"\\?'
        escaped.append(letter if is_plain else f"\\{byte:03o}")
    return f'"{"".join(escaped)}"'
