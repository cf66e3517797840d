"""Marks by which a program knows the files that programs of ours wrote, so that it replaces no
others.

A mark is a comment at the beginning of a file, or one of the first fields of a file in JSON. Files
in formats that have no place for a mark, such as CSV, are named in a list beside them, with the
SHA-256 sums of their contents.
"""

from __future__ import annotations

import errno
import hashlib
import re
from collections.abc import Iterable
from enum import Enum
from pathlib import Path

from dslkit.writing import is_stream, write_whole

_PROGRAMS = "crosscheck|ezskiros|heron|rossmarie"
_HEAD = 2048
"""The bytes of a file that are searched for its mark."""
_LINES = 3
"""The lines of a file that may hold the comment: an XML declaration can precede it."""
_COMMENT = re.compile(
    rf"^(?:#|//|<!--|/\*)\s*(?:Written|Generated) by `?(?:{_PROGRAMS})\b".encode(),
    re.IGNORECASE,
)
_FIELD = re.compile(rf'\A\s*\{{[^{{}}\[\]]*"(?:format|generator)":\s*"(?:{_PROGRAMS})\b'.encode())
_DECLARATIONS = ("<?xml", "<!DOCTYPE")
_LIST = ".written-by-{program}"


class Comment(Enum):
    """Comments of formats that a program does not recognize by the text alone."""

    HASH = "# {}"
    MARKUP = "<!-- {} -->"
    SLASHES = "// {}"


class NotOwnError(OSError):
    """A file that would be replaced was written by somebody else."""

    def __init__(self, path: Path) -> None:
        super().__init__(errno.EEXIST, "this program did not write it", str(path))


def is_own(content: bytes) -> bool:
    """Say whether a file with this content may be replaced: it is empty, or has a mark."""
    head = content[:_HEAD]
    lines = head.splitlines()[:_LINES]
    return not content or bool(_FIELD.match(head)) or any(map(_COMMENT.match, lines))


def require_own(path: Path) -> None:
    """Raise `NotOwnError` if a user's file is there, and `OSError` if it cannot be read.

    Terminals, pipes and devices have no content to lose.
    """
    if is_stream(path) or not path.is_file():
        return
    with path.open("rb") as stream:
        if not is_own(stream.read(_HEAD)) and not _is_listed(path):
            raise NotOwnError(path)


def marked(text: str, program: str, comment: Comment | None = None) -> str:
    """Add a program's mark to a text that lacks one. HTML and XML need no `comment`; a text in
    another format without one stays as it is.
    """
    if is_own(text.encode(errors="replace")) and text:
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
    """Give the name of the list beside files that cannot hold a mark, after it is written. Raises
    `OSError`.
    """
    name = _LIST.format(program=program)
    lines = [f"{_sum(folder / each)}  {each}\n" for each in names]
    write_whole(folder / name, f"# Written by {program}.\n{''.join(lines)}")
    return name


def _is_listed(path: Path) -> bool:
    """Say whether a list beside a file names it, and the file is as it was then."""
    lists = [path.with_name(_LIST.format(program=each)) for each in _PROGRAMS.split("|")]
    known = [each.read_text(encoding="utf-8", errors="replace") for each in lists if each.is_file()]
    return bool(known) and f"{_sum(path)}  {path.name}" in "".join(known).splitlines()


def _sum(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
