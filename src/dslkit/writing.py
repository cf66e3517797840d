"""Atomic writing of files, and checks before the writing."""

from __future__ import annotations

import errno
import io
import os
import shutil
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import IO, TextIO

_BLOCK = 4096
_ERRORS = "backslashreplace"


def write_whole(path: Path, content: str | bytes) -> None:
    """Write a file so that, whatever happens, it has either all of `content` or its old content.
    Its permissions stay. Text is written in UTF-8; invalid file names in it are written with
    escapes. Raises `OSError`.
    """
    with replacing(path) as stream:
        stream.write(content.encode(errors=_ERRORS) if isinstance(content, str) else content)


@contextmanager
def replacing(path: Path) -> Iterator[IO[bytes]]:
    """Within, a stream takes the new content of a file, which replaces the old one at the end. An
    exception within leaves the old one. A terminal, a pipe or a device takes the content at once.
    Raises `OSError`.
    """
    if is_stream(path):
        sys.stdout.flush()  # what was printed before comes before
        with path.open("ab") as stream:
            yield stream
        return
    target = Path(os.path.realpath(path))  # a link stays one
    is_there = target.exists()
    temporary = _begin(target)
    try:
        with temporary.open("wb") as stream:
            yield stream
            stream.flush()
            os.fsync(stream.fileno())  # some file systems only now report that they are full
        if is_there:
            shutil.copymode(target, temporary)
        temporary.replace(target)
    finally:
        temporary.unlink(missing_ok=True)


@contextmanager
def replacing_text(path: Path) -> Iterator[TextIO]:
    """As `replacing`, with a stream that takes text. Line endings stay as they are written."""
    with replacing(path) as stream:
        text = io.TextIOWrapper(stream, encoding="utf-8", errors=_ERRORS, newline="")
        try:
            yield text
        finally:
            text.detach()


def write_texts(folder: Path, texts: Mapping[str, str]) -> None:
    """Write texts into a new folder, by their paths in it. Raises `OSError`."""
    for name, text in texts.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def try_writing(path: Path) -> None:
    """Begin to write a file, and undo it. Raises the `OSError` that `write_whole` would raise."""
    target = Path(os.path.realpath(path))
    if target.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if is_stream(path):
        return
    temporary = _begin(target)
    try:
        with temporary.open("wb") as stream:
            stream.write(bytes(_BLOCK))
            stream.flush()
            os.fsync(stream.fileno())  # whether the file system is full
    finally:
        temporary.unlink()


def try_folder(folder: Path) -> None:
    """Try to write into a folder, which need not exist yet. The folder stays as it is.
    Raises `OSError` if no file can be written there.
    """
    place = Path(os.path.realpath(folder))
    while not os.path.lexists(place):
        place = place.parent
    if not place.is_dir():
        raise NotADirectoryError(errno.ENOTDIR, f"{place} is not a folder")
    try_writing(place / f".rossmarie-{os.getpid()}")


def is_stream(path: Path) -> bool:
    """Say whether a path leads to a terminal, a pipe or a device, which holds no content.
    `/dev/stdout` is one also where a shell leads it into a file, which it has emptied itself.
    """
    is_open_file = str(path).startswith(("/dev/std", "/dev/fd/", "/proc/self/fd/"))
    return path.exists() and not path.is_dir() and (is_open_file or not path.is_file())


def _begin(target: Path) -> Path:
    """A file beside the target, which is going to replace it."""
    if target.exists():
        target.open("r+b").close()  # replacing it would get around its write protection
    temporary = target.with_name(f".rossmarie-{os.getpid()}.tmp")
    temporary.touch()
    return temporary


def reason(error: OSError) -> str:
    """The reason why something failed, in words."""
    words = error.strerror or str(error) or "it cannot be done"
    return words[:1].lower() + words[1:]
