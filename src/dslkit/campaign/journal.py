"""The journal of a campaign: one JSON line for each episode, on disk before it is reported.

Its first line identifies the campaign, so that results of other programs are not mixed in.
"""

from __future__ import annotations

import fcntl
import json
import os
from pathlib import Path
from typing import IO

from dslkit.campaign.workers import Value

_HEAD = b'{"journal_of": '


class BusyError(Exception):
    """Another process writes to this journal."""


class ForeignError(Exception):
    """The journal belongs to another campaign, or is not a journal."""


class Journal:
    """A journal, for use in a `with` statement: only one process at a time can open it."""

    def __init__(self, path: Path, subject: str) -> None:
        self._path = path
        self._subject = subject
        self._file: IO[bytes] | None = None
        self.values: dict[str, Value] = {}
        """The rows in the journal, by key."""

    def __enter__(self) -> Journal:
        self._path.parent.mkdir(parents=True, exist_ok=True)
        self._file = self._path.open("a+b")
        try:
            self._take(self._file)
        except BaseException:
            self._file.close()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        assert self._file is not None
        self._file.close()

    def append(self, key: str, value: Value) -> None:
        """Append a result, which is on disk on return. An existing key keeps its result."""
        if key not in self.values:
            self._write({"key": key, **value})
            self.values[key] = value

    def _take(self, file: IO[bytes]) -> None:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise BusyError(f"{self._path} is in use by another run") from None
        file.seek(0)
        text = file.read()
        whole = text[: text.rfind(b"\n") + 1]
        if whole:
            self._read(whole)
        elif not _HEAD.startswith(text[: len(_HEAD)]):
            raise ForeignError(f"{self._path} is not a campaign journal")
        file.truncate(len(whole))  # a line whose write was interrupted
        if not whole:
            self._write({"journal_of": self._subject})
            _keep_entry(self._path.parent)

    def _read(self, text: bytes) -> None:
        try:
            head, *lines = map(json.loads, text.splitlines())
            subject = head["journal_of"]
            for line in lines:
                self.values.setdefault(line.pop("key"), line)
        except (ValueError, KeyError, TypeError, AttributeError):
            raise ForeignError(f"{self._path} is not a campaign journal") from None
        if subject != self._subject:
            raise ForeignError(f"{self._path} is the journal of {subject}, not of {self._subject}")

    def _write(self, line: dict[str, object]) -> None:
        assert self._file is not None
        self._file.write(json.dumps(line, allow_nan=False).encode() + b"\n")
        self._file.flush()
        os.fsync(self._file.fileno())


def _keep_entry(folder: Path) -> None:
    """Sync the folder, so that the entry of the file is on disk, too."""
    number = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(number)
    finally:
        os.close(number)
