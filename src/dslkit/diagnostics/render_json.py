"""Findings for programs, as JSON in a stable format: see `docs/reference/json-output.md`."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import TypeAlias

from dslkit.diagnostics.counting import count
from dslkit.diagnostics.model import Diagnostic, Fix, Label, Severity
from dslkit.source import Position, Span

FORMAT_VERSION = 1

Json: TypeAlias = "bool | int | float | str | Sequence[Json] | Mapping[str, Json] | None"


def render_json(
    diagnostics: Sequence[Diagnostic],
    *,
    command: str,
    file_count: int,
    result: Json = None,
    error: str | None = None,
) -> str:
    """One JSON object in ASCII, with a final newline.

    `command` is the program with the name of the command, `result` the result of the command, and
    `error` the reason why there is no result.
    """
    document: Json = {
        "version": FORMAT_VERSION,
        "command": command,
        "summary": {
            "errors": count(diagnostics, Severity.ERROR),
            "warnings": count(diagnostics, Severity.WARNING),
            "notes": count(diagnostics, Severity.NOTE),
            "files": file_count,
        },
        "diagnostics": [finding(found) for found in diagnostics],
        "result": result,
        "error": error,
    }
    return json.dumps(document, indent=2) + "\n"


def finding(found: Diagnostic) -> Json:
    """One finding, as an object."""
    return {
        "code": found.code,
        "name": found.name,
        "severity": found.severity.value,
        "title": found.title,
        "primary": _label(found.primary),
        "labels": [_label(label) for label in found.labels],
        "notes": list(found.notes),
        "help": found.help,
        "fix": None if found.fix is None else _fix(found.fix),
    }


def _label(label: Label) -> Json:
    return {**place(label.span), "text": label.text}


def _fix(fix: Fix) -> Json:
    edits = [{**place(edit.span), "replacement": edit.replacement} for edit in fix.edits]
    return {"title": fix.title, "edits": edits}


def place(span: Span) -> Mapping[str, Json]:
    """A place in a file, as an object."""
    return {
        "file": span.file.path,
        "start": _position(span.begin, span.start),
        "end": _position(span.finish, span.end),
    }


def _position(position: Position, offset: int) -> Json:
    return {"line": position.line, "column": position.column, "offset": offset}
