"""Copies of example folders for users: all files or none. Existing files stay unless the caller
allows their replacement.
"""

from __future__ import annotations

import difflib
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TypeVar

from dslkit.writing import write_whole

Example = TypeVar("Example")


class UnknownExampleError(LookupError):
    """There is no example of this name. The message is for the user."""


class FilesAreThereError(Exception):
    """Files of this name exist already: `paths`. No file was written."""

    def __init__(self, paths: Sequence[Path]) -> None:
        super().__init__(", ".join(map(str, paths)))
        self.paths = paths


def named(known: Mapping[str, Example], name: str, kind: str) -> Example:
    """The example with a name, in upper or lower case. `kind` is the word for it in the message.
    Raises `UnknownExampleError`.
    """
    if found := known.get(name.lower()):
        return found
    near = difflib.get_close_matches(name.lower(), known, n=1)
    hint = f"did you mean `{near[0]}`?" if near else f"there are {', '.join(known)}"
    raise UnknownExampleError(f"there is no {kind} `{name}`; {hint}")


def files_of(folder: Path) -> Sequence[Path]:
    """All files of an example, as paths in its folder, sorted by name."""
    inside = (path for path in folder.rglob("*") if path.is_file())
    return sorted(path.relative_to(folder) for path in inside if "__pycache__" not in path.parts)


def copy_example(example: Path, folder: Path, *, replaces_others: bool = False) -> Sequence[Path]:
    """Copy the files of an example into a folder, which is created if necessary, and return the
    written paths.

    Raises `FilesAreThereError` before anything is written, unless the copy `replaces_others`, and
    `OSError`.
    """
    files = files_of(example)
    targets = [folder / each for each in files]
    present = [path for path in targets if os.path.lexists(path)]
    if present and not replaces_others:
        raise FilesAreThereError(present)
    for source, target in zip(files, targets, strict=True):
        target.parent.mkdir(parents=True, exist_ok=True)
        write_whole(target, (example / source).read_bytes())
    return targets
