"""Opening the files of a bag: as they should be, or what can be salvaged of them."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path

from dslkit.diagnostics import Diagnostic
from rossmarie.ir import EARLIEST_NS, LATEST_NS
from rossmarie.recordings.bag import BagRecording
from rossmarie.recordings.clock import find_setbacks
from rossmarie.recordings.errors import (
    RecordingCorrupt,
    RecordingDamaged,
    RecordingEmpty,
    RecordingError,
    at_file,
)
from rossmarie.recordings.files import METADATA
from rossmarie.recordings.merged import MergedStorage
from rossmarie.recordings.salvage_bag import salvage_bag
from rossmarie.recordings.salvage_mcap import salvage_mcap
from rossmarie.recordings.salvage_sqlite import salvage_sqlite
from rossmarie.recordings.storage import READER_FAILURES, IntactStorage, SalvageableStorage, Storage

_ARRIVAL_FAILURES: tuple[type[Exception], ...] = (*READER_FAILURES, sqlite3.Error)


def open_bag(path: Path, files: Sequence[Path], message_folders: Sequence[Path]) -> BagRecording:
    """Open the bag at `path`, which consists of `files`. Raises `RecordingError`."""
    findings: tuple[Diagnostic, ...] = ()

    def salvage() -> Storage:
        return _salvage(path, files)[0]

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
        raise RecordingError(at_file(RecordingEmpty(reason="it holds no message"), path))
    findings += _setbacks(storage, path)
    return BagRecording(path, storage, span, salvage, message_folders, findings)


def _span(storage: Storage) -> tuple[int, int] | None:
    """The stamps of the first and the last message at an instant that can be; None if there is
    none.
    """
    span = storage.span()
    if span is None or (span[0] > EARLIEST_NS and span[1] < LATEST_NS):
        return span
    stamps = [at_ns for _, at_ns in storage.arrivals() if EARLIEST_NS < at_ns < LATEST_NS]
    return (min(stamps), max(stamps)) if stamps else None


def _setbacks(storage: Storage, path: Path) -> tuple[Diagnostic, ...]:
    """What is found out about the clock, as long as the file is not damaged there."""
    try:
        return find_setbacks(storage.arrivals(), path)
    except _ARRIVAL_FAILURES:
        return ()  # told when its messages are read


def _intact(path: Path, files: Sequence[Path]) -> Storage:
    if path.is_file() or (path / METADATA).is_file():
        return IntactStorage(path)
    with ExitStack() as opened:
        parts = []
        for file in files:
            parts.append(IntactStorage(file))
            opened.callback(parts[-1].close)
        opened.pop_all()  # all are open: they are closed with the recording
    return MergedStorage(parts)


def _salvage(path: Path, files: Sequence[Path]) -> tuple[Storage, list[str]]:
    """What is left of some files, and what is missing. Raises `RecordingError` if it is all."""
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
        merged = MergedStorage(parts)
        if merged.span() is None:
            reason = losses[0] if losses else "it holds no message"
            raise RecordingError(at_file(RecordingCorrupt(reason=reason), path))
        opened.pop_all()  # closed with the recording
    return merged, losses


def _refuse_compressed(file: Path) -> SalvageableStorage:
    raise ValueError(f"`{file.name}` is compressed as a whole; `zstd -d` makes a file of it")


_SALVAGE: Mapping[str, Callable[[Path], SalvageableStorage]] = {
    ".bag": salvage_bag,
    ".db3": salvage_sqlite,
    ".mcap": salvage_mcap,
    ".zstd": _refuse_compressed,
}
