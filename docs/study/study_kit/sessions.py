"""Sessions of participants: their folders, and the log of the progress in each."""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

from study_kit import tools
from study_kit.faults import CONDITIONS, KIT, Condition, plant, planted_in, states

FORMAT = "study-kit-progress"
VERSION = 1
PROGRESS = "progress.jsonl"
FINDINGS = "findings.jsonl"
WORK = "work"


class SessionError(ValueError):
    """A session that cannot be prepared or read, with the reason."""


@dataclass(frozen=True)
class Session:
    """One participant, one condition, one folder."""

    participant: str
    condition: Condition
    folder: Path

    @property
    def file(self) -> Path:
        """The file that the participant changes."""
        return self.folder / WORK / self.condition.file


def prepare(participant: str, condition: Condition, sessions: Path) -> Session:
    """Make the folder of a session: the task sheet and the starting files, without the list.

    Raises `SessionError` for a name that is not plain and for a folder that exists.
    """
    if not re.fullmatch("[A-Za-z0-9]+", participant):
        raise SessionError(f"`{participant}` is no pseudonym: use letters and digits, such as P01")
    folder = sessions / f"{participant}-{condition.name}"
    if folder.exists():
        raise SessionError(f"{folder} exists already: choose another pseudonym or move the folder")
    folder.mkdir(parents=True)
    work = folder / WORK
    tools.lay_out(condition, plant(condition, planted_in(condition)), work)
    shutil.copy(KIT / "tasks" / condition.task / "sheet.md", work / "TASK.md")
    return Session(participant, condition, folder)


def session_of(folder: Path) -> Session:
    """The session of a folder that `prepare` made. Raises `SessionError` for another folder."""
    participant, _, name = folder.resolve().name.partition("-")
    condition = CONDITIONS.get(name)
    if condition is None or not (folder / WORK / condition.file).is_file():
        raise SessionError(f"{folder} is no session: `study.py prepare` makes one")
    return Session(participant, condition, folder)


def note(session: Session, event: str, content: bytes) -> Mapping[str, Any]:
    """Append the state of each planted fault to the log of the progress, and return the line."""
    found = states(session.condition, content.decode("utf-8", errors="replace"))
    line = {
        "format": FORMAT,
        "version": VERSION,
        "time": datetime.now(timezone.utc).isoformat(timespec="milliseconds"),
        "participant": session.participant,
        "task": session.condition.task,
        "condition": session.condition.name,
        "event": event,
        "sha256": hashlib.sha256(content).hexdigest(),
        "faults": {name: state.value for name, state in found.items()},
    }
    with (session.folder / PROGRESS).open("a", encoding="utf-8") as log:
        log.write(json.dumps(line) + "\n")
    return line


def watch(
    session: Session,
    seconds: float,
    tell: Callable[[Mapping[str, Any]], None],
    period: float = 1.0,
) -> None:
    """Note the start, each change of the file, and the end: after `seconds` or at Ctrl-C."""
    content = session.file.read_bytes()
    tell(note(session, "start", content))
    end = time.monotonic() + seconds
    try:
        while time.monotonic() < end:
            time.sleep(min(period, max(0.0, end - time.monotonic())))
            now = _content(session.file)
            if now not in (None, content):
                content = now or b""
                tell(note(session, "change", content))
    except KeyboardInterrupt:
        pass
    tell(note(session, "end", content))


def _content(file: Path) -> bytes | None:
    """The content of a file, or none while an editor replaces the file."""
    try:
        return file.read_bytes()
    except OSError:
        return None


def read_progress(path: Path) -> list[dict[str, Any]]:
    """The lines of a log of the progress. Raises `SessionError` with the place of a wrong line."""
    lines = []
    for number, text in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        try:
            line = json.loads(text)
        except ValueError:
            raise SessionError(f"{path}:{number}:1: this line is not JSON") from None
        if not isinstance(line, dict) or (line.get("format"), line.get("version")) != (
            FORMAT,
            VERSION,
        ):
            raise SessionError(f"{path}:{number}:1: this line is not of a progress log")
        lines.append(line)
    if not lines:
        raise SessionError(f"{os.fspath(path)} has no lines: run `study.py watch` in the session")
    return lines
