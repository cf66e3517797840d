"""The files behind a statement about rules, with their hashes: rules files as they were checked,
other files as they are on the disk.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from dslkit.source import SourceFile
from rossmarie.driver.workspace import LIBRARY
from rossmarie.report.safety.evidence import Hashed

_PIECE = 1 << 20


def hashed_sources(sources: Sequence[SourceFile], rules: Path) -> tuple[Hashed, ...]:
    """All files of `Compiled.sources`, with names relative to the main file."""
    return tuple(Hashed(name_of(Path(each.path), rules), each.sha256) for each in sources)


def hashed_files(path: Path, rules: Path) -> Iterator[Hashed]:
    """A file, or all files in a folder, from the disk. Raises `OSError`."""
    files = sorted(each for each in path.rglob("*") if each.is_file()) if path.is_dir() else [path]
    for file in files:
        digest = hashlib.sha256()
        with file.open("rb") as stream:
            while piece := stream.read(_PIECE):
                digest.update(piece)
        yield Hashed(name_of(file, rules), digest.hexdigest())


def name_of(path: Path, rules: Path) -> str:
    """The name of a file relative to the main rules file."""
    if path.parent == LIBRARY:
        return f"rossmarie/{path.name}"
    return Path(os.path.relpath(path, rules.parent)).as_posix()
