"""Study logs: local files that record the findings of each check, for studies with users.

A log has one JSON object per line and one line per run of a check. `docs/study/log.md` describes
the format, and `docs/study/log.schema.json` is its schema. A log never contains the text of a
checked file, and this module sends nothing anywhere.
"""

from __future__ import annotations

import hashlib
import json
import os
import stat
from collections.abc import Mapping, Sequence
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

from dslkit.diagnostics import Diagnostic
from dslkit.source import Position

FORMAT = "dslkit-study-log"
VERSION = 1


class StudyLogError(ValueError):
    """A file that is not a study log, with the reason and the line (counted from 1; 0 for none)."""

    def __init__(self, reason: str, line: int = 0) -> None:
        super().__init__(reason)
        self.reason = reason
        self.line = line


def try_log(path: Path) -> None:
    """Try to append to a log without a change to it.

    Raises `StudyLogError` for a file that is not a log, and `OSError` for a log that cannot be
    written.
    """
    if not os.path.lexists(path):
        if not path.parent.is_dir():
            raise NotADirectoryError(0, f"there is no folder {path.parent}")
        if not os.access(path.parent, os.W_OK):
            raise PermissionError(0, f"the folder {path.parent} is write-protected")
        return
    if not stat.S_ISREG(path.stat().st_mode):
        raise StudyLogError("it is not a regular file")
    with path.open("r+b"):
        read_log(path)


def append(
    path: Path,
    *,
    tool: str,
    command: str,
    release: str,
    files: Sequence[Path],
    found: Sequence[Diagnostic],
) -> None:
    """Append one run: its time, its command, the digests of its files, and its findings.

    Raises `OSError` for a log that cannot be written.
    """
    folder = path.resolve().parent
    run = {
        "format": FORMAT,
        "version": VERSION,
        "time": datetime.now(timezone.utc).isoformat(timespec="milliseconds"),
        "tool": tool,
        "command": command,
        "release": release,
        "files": [{"name": _name(each, folder), "sha256": _digest(each)} for each in files],
        "findings": [_finding(each, folder) for each in found],
    }
    line = json.dumps(run) + "\n"
    handle = os.open(path, os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o600)
    try:
        os.write(handle, line.encode())  # one call, so that two runs at once do not mix their lines
    finally:
        os.close(handle)


def read_log(path: Path) -> list[dict[str, Any]]:
    """All runs in a log, first to last. Raises `StudyLogError` and `OSError`."""
    try:
        text = path.read_bytes().decode()
    except UnicodeDecodeError:
        raise StudyLogError("it is not text in UTF-8") from None
    if text and not text.endswith("\n"):
        raise StudyLogError("its last line is incomplete", text.count("\n") + 1)
    lines = text.split("\n")[:-1]
    return [_run(line, number) for number, line in enumerate(lines, start=1)]


_FIELDS: Mapping[str, type] = {
    "time": str,
    "tool": str,
    "command": str,
    "release": str,
    "files": list,
    "findings": list,
}


def _run(line: str, number: int) -> dict[str, Any]:
    try:
        run = json.loads(line)
    except (ValueError, RecursionError):
        raise StudyLogError("this line is not JSON", number) from None
    if not isinstance(run, dict) or run.get("format") != FORMAT:
        raise StudyLogError(f'this line does not have "format": "{FORMAT}"', number)
    if run.get("version") != VERSION:
        raise StudyLogError(
            f"this line has version {run.get('version')!r} of the format, not {VERSION}", number
        )
    for name, kind in _FIELDS.items():
        if not isinstance(run.get(name), kind):
            raise StudyLogError(f"`{name}` of this line is missing or has the wrong type", number)
    return run


def _name(path: str | Path, folder: Path) -> str:
    """The path relative to the folder of the log, or only the file name, so that no log names other
    folders.
    """
    whole = Path(path).resolve()
    try:
        return whole.relative_to(folder).as_posix()
    except ValueError:
        return whole.name


def _digest(path: Path) -> str | None:
    """The SHA-256 of a file in hexadecimal; None for an unreadable file."""
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError:
        return None


def _finding(found: Diagnostic, folder: Path) -> Mapping[str, object]:
    """The code and the place of a finding, without its texts, because texts can quote the user's
    code.
    """
    span = found.primary.span
    return {
        "code": found.code,
        "severity": found.severity.value,
        "file": _name(span.file.path, folder),
        "start": _position(span.begin),
        "end": _position(span.finish),
    }


def _position(position: Position) -> Mapping[str, int]:
    return {"line": position.line, "column": position.column}
