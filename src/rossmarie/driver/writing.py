"""Files that are written as a whole, or stay as they are."""

from __future__ import annotations

import os
import shutil
from pathlib import Path


def write_whole(path: Path, text: str) -> None:
    """Write a file in UTF-8 so that, whatever happens, it holds either all of `text` or what it
    held before. Its permissions stay. Raises `OSError`.
    """
    target = Path(os.path.realpath(path))  # a link stays one
    if target.exists() and not target.is_file():  # a terminal or a pipe, which has no contents
        target.write_text(text, encoding="utf-8", newline="")
        return
    is_there = target.exists()
    if is_there:
        target.open("r+b").close()  # replacing it would get around its write protection
    temporary = target.with_name(f".rossmarie-{os.getpid()}.tmp")
    try:
        with temporary.open("w", encoding="utf-8", newline="") as stream:
            stream.write(text)
            stream.flush()
            os.fsync(stream.fileno())  # some file systems notice only now that they are full
        if is_there:
            shutil.copymode(target, temporary)
        temporary.replace(target)
    finally:
        temporary.unlink(missing_ok=True)


def reason(error: OSError) -> str:
    """Why something could not be done, in words."""
    return (error.strerror or str(error) or "it cannot be done").lower()
