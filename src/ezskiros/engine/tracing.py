"""Events as JSON lines, for other programs."""

from __future__ import annotations

import enum
import json
from collections.abc import Mapping
from typing import Any, TextIO

from ezskiros.engine.events import Event
from ezskiros.engine.values import WorldIndividual


class TraceWriter:
    """Writes one JSON object per event. The first object names the `program` that writes it. Raises
    `OSError`, like files.

    `start_ns` is the start of the task in nanoseconds since 1970 (UTC), the clock of recordings.
    """

    def __init__(self, file: TextIO, start_ns: int, program: str = "ezskiros") -> None:
        self._file = file
        self._start_ns = start_ns
        self._mark = {"generator": program}

    def write(self, event: Event, tick: int, seconds: float) -> None:
        """Write an event, with the number of its tick (from 1) and the seconds since the start of
        the task.
        """
        line: dict[str, object] = {
            **self._when(tick, seconds),
            "event": event.happened.value,
            "path": list(event.path),
            "skill": event.skill,
            "implementation": event.implementation or None,
            "code": int(event.code),
            "text": event.text,
        }
        if event.values:
            line["parameters"] = {name: _plain(value) for name, value in event.values.items()}
        self._write(line)

    def write_context(self, context: Mapping[str, Any], tick: int, seconds: float) -> None:
        """Write the running skills, in the format of their message."""
        line = {**self._when(tick, seconds), "event": "context", **context}
        self._write(line, allow_nan=False)

    def _write(self, line: Mapping[str, object], *, allow_nan: bool = True) -> None:
        line = {**self._mark, **line}
        text = json.dumps(line, ensure_ascii=False, allow_nan=allow_nan)
        self._file.write(f"{text}\n")
        self._mark = {}

    def _when(self, tick: int, seconds: float) -> dict[str, object]:
        """The time of a line. Its stamp is derived from `seconds`, so that it never decreases."""
        at_ns = self._start_ns + round(seconds * 1e9)
        return {"tick": tick, "time": round(seconds, 6), "at_ns": at_ns}


def _plain(value: Any) -> object:
    """A value as JSON data: individuals as IRIs, members of enumerations as names."""
    if isinstance(value, WorldIndividual):
        return value.iri
    return value.name if isinstance(value, enum.Enum) else value
