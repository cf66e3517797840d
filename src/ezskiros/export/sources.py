"""The source files of an export, and their digest."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

FORMAT = "ezskiros/skills"
VERSION = 1
"""The version is a part of the digest, so that no file matches an export of another version."""


@dataclass(frozen=True, order=True)
class ExportedSource:
    """A file by its path relative to the folder of the export, with `/`, and the SHA-256 of its
    bytes.
    """

    path: str
    sha256: str


def digest_of(sources: Iterable[ExportedSource]) -> str:
    """The digest of an export: 64 hexadecimal digits."""
    lines = [f"{FORMAT} {VERSION}", *(f"{each.sha256}  {each.path}" for each in sorted(sources))]
    return hashlib.sha256("\n".join(lines).encode("utf-8", "surrogatepass")).hexdigest()


def sources_of(files: Iterable[Path], folder: Path) -> list[ExportedSource]:
    """Some files as sources of an export in a folder, in order. Raises `OSError`."""
    known = {path_from(folder, file): file for file in files}
    return sorted(ExportedSource(path, sha256_of(file)) for path, file in known.items())


def sha256_of(file: Path) -> str:
    """The SHA-256 of the bytes of a file. Raises `OSError`."""
    return hashlib.sha256(file.read_bytes()).hexdigest()


def path_from(folder: Path, file: str | os.PathLike[str]) -> str:
    """The path from a folder to a file, with `/`."""
    relative = os.path.relpath(os.path.realpath(file), os.path.realpath(folder))
    return relative.replace(os.sep, "/")
