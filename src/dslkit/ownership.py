"""Marks by which a program recognizes the files that it wrote, so that it replaces no other files.

A mark is a comment at the beginning of a file, or one of the first fields of a JSON file. Formats
without a place for a mark, such as CSV, are named in a list beside the files, with the SHA-256 sums
of their contents.
"""

from __future__ import annotations

import errno
import hashlib
import re
from collections.abc import Iterable
from enum import Enum
from pathlib import Path

from dslkit.writing import is_stream, write_whole

_HEAD = 2048
"""The number of bytes that are searched for the mark."""
_LINES = 3
"""The lines of a file that may hold the comment: an XML declaration can precede it."""
_COMMENT = r"(?:#|//|<!--|/\*)\s*(?:Written|Generated) by `?{program}\b"
_FIELD = r'\A\s*\{{[^{{}}\[\]]*"(?:format|generator)":\s*"{program}\b'
_DECLARATIONS = ("<?xml", "<!DOCTYPE")
_LIST = ".written-by-{program}"


class Comment(Enum):
    """Comments of formats that a program does not recognize by the text alone."""

    HASH = "# {}"
    MARKUP = "<!-- {} -->"
    SLASHES = "// {}"


class NotOwnError(OSError):
    """The file to be replaced was not written by this program."""

    def __init__(self, path: Path) -> None:
        super().__init__(errno.EEXIST, "this program did not write it", str(path))


def is_own(content: bytes, program: str) -> bool:
    """Say whether a program may replace a file with this content: the file is empty or has the mark
    of the program.
    """
    head = content[:_HEAD].decode(errors="replace")
    comment, field = (each.format(program=program) for each in (_COMMENT, _FIELD))
    has_comment = any(re.match(comment, each, re.IGNORECASE) for each in head.splitlines()[:_LINES])
    return not content or has_comment or bool(re.match(field, head))


def require_own(path: Path, program: str) -> None:
    """Raise `NotOwnError` if a user's file exists there, and `OSError` if it cannot be read.

    Terminals, pipes and devices have no content to lose.
    """
    if is_stream(path) or not path.is_file():
        return
    with path.open("rb") as stream:
        if not is_own(stream.read(_HEAD), program) and not _is_listed(path, program):
            raise NotOwnError(path)


def marked(text: str, program: str, comment: Comment | None = None) -> str:
    """Add a program's mark to a text without one. HTML and XML need no `comment`; other formats
    without a comment stay unchanged.
    """
    if text and is_own(text.encode(errors="replace"), program):
        return text
    mark = f"Written by {program}."
    if text.startswith("<"):
        first, rest = "", text
        if text.startswith(_DECLARATIONS):
            first, end, rest = text.partition("\n")
            first += end
        return f"{first}{Comment.MARKUP.value.format(mark)}\n{rest}"
    return text if comment is None else f"{comment.value.format(mark)}\n{text}"


def list_written(folder: Path, names: Iterable[str], program: str) -> str:
    """Write the list beside files that cannot hold a mark. Returns the name of the list. Raises
    `OSError`.
    """
    name = _LIST.format(program=program)
    lines = [f"{_sum(folder / each)}  {each}\n" for each in names]
    write_whole(folder / name, f"# Written by {program}.\n{''.join(lines)}")
    return name


def _is_listed(path: Path, program: str) -> bool:
    """Say whether the list beside a file names it, and the file is unchanged since then."""
    written = path.with_name(_LIST.format(program=program))
    if not written.is_file():
        return False
    lines = written.read_text(encoding="utf-8", errors="replace").splitlines()
    return f"{_sum(path)}  {path.name}" in lines


def _sum(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
