"""The files that belong to the path of a recording."""

from __future__ import annotations

import difflib
import re
from pathlib import Path

from dslkit.diagnostics import DidYouMean, Remark
from rossmarie.recordings.errors import (
    RecordingEmpty,
    RecordingError,
    RecordingKindUnknown,
    RecordingNotFound,
    RecordingUnreadable,
    at_file,
)

METADATA = "metadata.yaml"
"""The name of a file beside the files of a ROS 2 bag. A recorder that crashes does not write it."""

PACKED = ".zstd"
"""The suffix of a file of a ROS 2 bag that is compressed as a whole."""

_BAGS = (".bag", ".db3", ".mcap")
_KINDS = (*_BAGS, ".csv")


def recording_files(path: Path) -> list[Path]:
    """The non-empty files of a recording.

    Raises `RecordingError` if no file can be opened.
    """
    try:
        files = _files(path)
        filled = [file for file in files if file.stat().st_size > 0]
        for file in filled:
            file.open("rb").close()
    except OSError as error:
        reason = (error.strerror or "it cannot be read").lower()
        raise RecordingError(at_file(RecordingUnreadable(reason=reason), path)) from error
    if not filled:
        raise RecordingError(at_file(RecordingEmpty(reason="it has no content"), path))
    return filled


def _files(path: Path) -> list[Path]:
    """The files of a recording, including empty files."""
    if path.is_dir():
        return _files_in(path)
    if not path.exists():
        raise RecordingError(at_file(RecordingNotFound(), path, help=_similar(path)))
    if path.suffix not in _KINDS:
        ending = f"`{path.suffix}`" if path.suffix else "a name without an extension"
        reason = f"{ending} is not a supported kind of recording"
        raise RecordingError(at_file(RecordingKindUnknown(reason=reason), path))
    return [path]


def _files_in(folder: Path) -> list[Path]:
    """The storage files of a bag directory. The files of a long recording have numbers in their
    names.
    """
    found = [file for file in sorted(folder.iterdir()) if file.suffix in _BAGS and file.is_file()]
    has_metadata = (folder / METADATA).is_file()
    if has_metadata:
        found += folder.glob(f"*{PACKED}")
    if not found:
        reason = "there is no recording in this directory"
        raise RecordingError(at_file(RecordingKindUnknown(reason=reason), folder))
    if not has_metadata and len({_unnumbered(file) for file in found}) > 1:
        names = ", ".join(sorted(f"`{file.name}`" for file in found))
        reason = f"there are several recordings in this directory: {names}"
        raise RecordingError(at_file(RecordingKindUnknown(reason=reason), folder))
    return found


def _unnumbered(file: Path) -> str:
    return re.sub(r"_\d+$", "", file.stem) + file.suffix


def _similar(path: Path) -> Remark:
    folder = path.parent
    present = {found.stem: found for found in folder.iterdir()} if folder.is_dir() else {}
    near = difflib.get_close_matches(path.stem, present, n=1)
    return DidYouMean(near=str(present[near[0]])) if near else RecordingNotFound.CheckPath()
