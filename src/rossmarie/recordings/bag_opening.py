"""Opening the files of a bag: complete, or the part that can be salvaged."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from dslkit.diagnostics import Diagnostic
from rossmarie.ir import EARLIEST_NS, LATEST_NS
from rossmarie.recordings.bag import BagRecording
from rossmarie.recordings.clock import find_setbacks
from rossmarie.recordings.compression import unpacked
from rossmarie.recordings.errors import (
    RecordingCorrupt,
    RecordingDamaged,
    RecordingEmpty,
    RecordingError,
    at_file,
)
from rossmarie.recordings.files import METADATA, PACKED
from rossmarie.recordings.intact_bag import IntactBag
from rossmarie.recordings.limits import Allowance, LimitError
from rossmarie.recordings.merged import MergedStorage
from rossmarie.recordings.salvage_bag import salvage_bag
from rossmarie.recordings.salvage_mcap import salvage_mcap
from rossmarie.recordings.salvage_sqlite import salvage_sqlite
from rossmarie.recordings.storage import IntactStorage, SalvageableStorage, Storage
from rossmarie.recordings.stored import READER_FAILURES

_ARRIVAL_FAILURES: tuple[type[Exception], ...] = (*READER_FAILURES, sqlite3.Error)


def open_bag(path: Path, files: Sequence[Path], message_folders: Sequence[Path]) -> BagRecording:
    """Open the bag at `path`, which consists of `files`. Raises `RecordingError`."""
    findings: tuple[Diagnostic, ...] = ()

    try:
        storage = _intact(path, files)
    except READER_FAILURES:
        storage, losses = _salvage(path, files)
        kept = sum(connection.count for connection in storage.connections)
        findings = tuple(
            at_file(RecordingDamaged(reason=reason, kept=kept), path) for reason in losses
        )
    span = _span(storage)
    if span is None:
        storage.close()
        raise RecordingError(at_file(RecordingEmpty(reason="it contains no messages"), path))
    findings += _setbacks(storage, path)
    return BagRecording(
        path, storage, span, partial(_salvage, path, files), message_folders, findings
    )


def _span(storage: Storage) -> tuple[int, int] | None:
    """The stamps of the first and the last message at a possible instant; None if there is none."""
    span = storage.span()
    if span is None or (span[0] > EARLIEST_NS and span[1] < LATEST_NS):
        return span
    found = [
        stamps[(stamps > EARLIEST_NS) & (stamps < LATEST_NS)] for _, stamps in storage.arrivals()
    ]
    spans = [(int(stamps.min()), int(stamps.max())) for stamps in found if len(stamps)]
    if not spans:
        return None
    return min(start for start, _ in spans), max(end for _, end in spans)


def _setbacks(storage: Storage, path: Path) -> tuple[Diagnostic, ...]:
    """The findings about the clock, for the part of the file before any damage."""
    try:
        return find_setbacks(storage.arrivals(), path)
    except _ARRIVAL_FAILURES:
        return ()  # the damage is reported when the messages are read


def _intact(path: Path, files: Sequence[Path]) -> Storage:
    allowance = Allowance(sum(file.stat().st_size for file in files))
    is_packed = any(file.suffix == PACKED for file in files)
    if path.is_file() or ((path / METADATA).is_file() and not is_packed):
        return _intact_part(path, allowance)
    with ExitStack() as opened:
        folder = Path(opened.enter_context(TemporaryDirectory()))
        parts = []
        for file in files:
            found = _unpacked(file, folder, allowance) if file.suffix == PACKED else file
            parts.append(_intact_part(found, allowance))
            opened.callback(parts[-1].close)
        return MergedStorage(parts, opened.pop_all())  # the recording closes all of them


def _intact_part(path: Path, allowance: Allowance) -> IntactBag | IntactStorage:
    is_bag = path.suffix == ".bag" and path.is_file()
    return IntactBag(path, allowance) if is_bag else IntactStorage(path, allowance)


def _unpacked(file: Path, folder: Path, allowance: Allowance) -> Path:
    """The unpacked file. Raises `RecordingError` for a file beyond a limit; such a file cannot be
    salvaged.
    """
    try:
        return unpacked(file, folder, allowance)
    except LimitError as error:
        reason = f"`{file.name}` is compressed as a whole, and {error}"
        raise RecordingError(at_file(RecordingCorrupt(reason=reason), file)) from error


def _salvage(path: Path, files: Sequence[Path]) -> tuple[Storage, list[str]]:
    """The readable rest of some files, and the loss. Raises `RecordingError` if no file has a
    readable rest.
    """
    parts: list[SalvageableStorage] = []
    losses = []
    with ExitStack() as opened:
        for file in files:
            try:
                part = _SALVAGE[file.suffix](file)
            except ValueError as error:
                losses.append(str(error))
                continue
            opened.callback(part.close)
            parts.append(part)
            if part.loss is not None:
                losses.append(part.loss)
        if all(part.span() is None for part in parts):
            empty = RecordingEmpty(reason="it contains no messages")
            finding = RecordingCorrupt(reason=losses[0]) if losses else empty
            raise RecordingError(at_file(finding, path))
        return MergedStorage(parts, opened.pop_all()), losses  # the recording closes it


def _refuse_compressed(file: Path) -> SalvageableStorage:
    raise ValueError(f"`{file.name}` is compressed as a whole; decompress it with `zstd -d`")


_SALVAGE: Mapping[str, Callable[[Path], SalvageableStorage]] = {
    ".bag": salvage_bag,
    ".db3": salvage_sqlite,
    ".mcap": salvage_mcap,
    PACKED: _refuse_compressed,
}
