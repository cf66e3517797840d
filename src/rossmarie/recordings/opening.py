"""From a path to an open recording."""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from dslkit.diagnostics import Diagnostic
from rossmarie.recordings.bag import BagRecording
from rossmarie.recordings.csv_table import CsvRecording
from rossmarie.recordings.errors import (
    RecordingCorrupt,
    RecordingDamaged,
    RecordingEmpty,
    RecordingError,
    RecordingKindUnknown,
    RecordingNotFound,
    RecordingUnreadable,
    at_file,
)
from rossmarie.recordings.merged import MergedStorage
from rossmarie.recordings.model import Recording
from rossmarie.recordings.salvage_bag import salvage_bag
from rossmarie.recordings.salvage_mcap import salvage_mcap
from rossmarie.recordings.salvage_sqlite import salvage_sqlite
from rossmarie.recordings.storage import READER_FAILURES, IntactStorage, SalvageableStorage, Storage

_SALVAGE: Mapping[str, Callable[[Path], SalvageableStorage]] = {
    ".bag": salvage_bag,
    ".db3": salvage_sqlite,
    ".mcap": salvage_mcap,
}
_KINDS = (*_SALVAGE, ".csv")
_METADATA = "metadata.yaml"


def open_recording(path: Path, message_folders: Sequence[Path] = ()) -> Recording:
    """Open a ROS 1 .bag, a ROS 2 .db3 or .mcap or the directory that holds one, or a .csv.

    `message_folders` hold the .msg files of types that neither the recording nor a standard package
    of ROS defines. A damaged file is opened as far as it can be read, see `Recording.findings`.
    Raises `RecordingError` if that is not at all.
    """
    files = _files(path)
    try:
        if any(file.stat().st_size == 0 for file in files):
            raise RecordingError(at_file(RecordingEmpty(reason="it has no content"), path))
        for file in files:
            file.open("rb").close()
    except OSError as error:
        reason = (error.strerror or "it cannot be read").lower()
        raise RecordingError(at_file(RecordingUnreadable(reason=reason), path)) from error
    if files[0].suffix == ".csv":
        return CsvRecording(files[0])
    return _open_bag(path, files, message_folders)


def _open_bag(path: Path, files: Sequence[Path], message_folders: Sequence[Path]) -> BagRecording:
    findings: tuple[Diagnostic, ...] = ()

    def salvage() -> Storage:
        return _salvage(path, files)[0]

    try:
        storage: Storage = _intact(path, files)
    except READER_FAILURES:
        storage, losses = _salvage(path, files)
        kept = sum(connection.count for connection in storage.connections)
        findings = tuple(
            at_file(RecordingDamaged(reason=reason, kept=kept), path) for reason in losses
        )
    span = storage.span()
    if span is None:
        storage.close()
        raise RecordingError(at_file(RecordingEmpty(reason="it holds no message"), path))
    return BagRecording(path, storage, span, salvage, message_folders, findings)


def _intact(path: Path, files: Sequence[Path]) -> Storage:
    if path.is_file() or (path / _METADATA).is_file():
        return IntactStorage(path)
    return MergedStorage([IntactStorage(file) for file in files])


def _salvage(path: Path, files: Sequence[Path]) -> tuple[Storage, list[str]]:
    """What is left of some files, and what is missing. Raises `RecordingError` if it is all."""
    parts: list[SalvageableStorage] = []
    losses = []
    for file in files:
        try:
            part = _SALVAGE[file.suffix](file)
        except ValueError as error:
            losses.append(str(error))
            continue
        parts.append(part)
        if part.loss is not None:
            losses.append(part.loss)
    if not any(part.span() for part in parts):
        reason = losses[0] if losses else "it holds no message"
        raise RecordingError(at_file(RecordingCorrupt(reason=reason), path))
    return MergedStorage(parts), losses


# --- which files there are -------------------------------------------------------------------


def _files(path: Path) -> list[Path]:
    """The files of a recording, in the order in which they were written."""
    if path.is_dir():
        return _files_in(path)
    if not path.exists():
        raise RecordingError(at_file(RecordingNotFound(hint=_similar(path)), path))
    if path.suffix not in _KINDS:
        ending = f"`{path.suffix}`" if path.suffix else "a name without an ending"
        reason = f"{ending} is not a kind of recording that can be read"
        raise RecordingError(at_file(RecordingKindUnknown(reason=reason), path))
    return [path]


def _files_in(folder: Path) -> list[Path]:
    """The storage files of a bag directory; those of a long recording are numbered."""
    found = [file for file in folder.iterdir() if file.suffix in _SALVAGE and file.is_file()]
    compressed = list(folder.glob("*.zstd"))
    if (folder / _METADATA).is_file() and compressed:
        return compressed
    if not found:
        reason = "there is no recording in this directory"
        raise RecordingError(at_file(RecordingKindUnknown(reason=reason), folder))
    if len({_unnumbered(file) for file in found}) > 1:
        names = ", ".join(sorted(f"`{file.name}`" for file in found))
        reason = f"there are several recordings in this directory: {names}"
        raise RecordingError(at_file(RecordingKindUnknown(reason=reason), folder))
    return sorted(found, key=lambda file: (_number(file), file.name))


def _unnumbered(file: Path) -> str:
    return re.sub(r"_\d+$", "", file.stem) + file.suffix


def _number(file: Path) -> int:
    match = re.search(r"_(\d+)$", file.stem)
    return int(match.group(1)) if match else -1


def _similar(path: Path) -> str:
    folder = path.parent
    present = [found.name for found in folder.iterdir()] if folder.is_dir() else []
    near = difflib.get_close_matches(path.name, present, n=1)
    return f"did you mean `{folder / near[0]}`?" if near else "check the path"
