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
    """Write a file so that, after any failure, it has either all of `content` or its old content.
    Its permissions stay. Text is written in UTF-8; invalid file names in it are written with
    escapes. Raises `OSError`.
    """
    with replacing(path) as stream:
        stream.write(content.encode(errors=_ERRORS) if isinstance(content, str) else content)


@contextmanager
def replacing(path: Path) -> Iterator[IO[bytes]]:
    """While the context is active, a stream takes the new content of a file, which replaces the old
    content at the end. After an exception, the old content stays. A terminal, a pipe or a device
    takes the content immediately. Raises `OSError`.
    """
    if is_stream(path):
        sys.stdout.flush()  # earlier output comes first
        with path.open("ab") as stream:
            yield stream
        return
    target = Path(os.path.realpath(path))  # a link stays a link
    is_there = target.exists()
    temporary = _begin(target)
    try:
        with temporary.open("wb") as stream:
            yield stream
            stream.flush()
            os.fsync(stream.fileno())  # some file systems report only now that they are full
        if is_there:
            shutil.copymode(target, temporary)
        temporary.replace(target)
    finally:
        temporary.unlink(missing_ok=True)


@contextmanager
def replacing_text(path: Path) -> Iterator[TextIO]:
    """Like `replacing`, with a stream that takes text. Line endings are not converted."""
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
    """Begin to write a file, and undo this. Raises the `OSError` that `write_whole` would raise."""
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
            os.fsync(stream.fileno())  # reports a full file system
    finally:
        temporary.unlink()


def try_folder(folder: Path) -> None:
    """Try to write into a folder, which need not exist yet. The folder stays unchanged. Raises
    `OSError` if no file can be written there.
    """
    place = Path(os.path.realpath(folder))
    while not os.path.lexists(place):
        place = place.parent
    if not place.is_dir():
        raise NotADirectoryError(errno.ENOTDIR, f"{place} is not a folder")
    try_writing(place / f".rossmarie-{os.getpid()}")


def is_stream(path: Path) -> bool:
    """Say whether a path leads to a terminal, a pipe or a device, which has no content. This
    includes `/dev/stdout` if a shell redirects it to a file, because the shell has emptied that
    file.
    """
    is_open_file = str(path).startswith(("/dev/std", "/dev/fd/", "/proc/self/fd/"))
    return path.exists() and not path.is_dir() and (is_open_file or not path.is_file())


def _begin(target: Path) -> Path:
    """Create a file beside the target that will replace the target."""
    if target.exists():
        target.open("r+b").close()  # a replacement would bypass its write protection
    temporary = target.with_name(f".rossmarie-{os.getpid()}.tmp")
    temporary.touch()
    return temporary


def reason(error: OSError) -> str:
    """The reason of a failure, in words."""
    words = error.strerror or str(error) or "it cannot be done"
    return words[:1].lower() + words[1:]
