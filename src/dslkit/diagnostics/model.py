"""One finding, as plain data. Renderers turn it into text, JSON or SARIF."""

from __future__ import annotations

import enum
from dataclasses import dataclass

from dslkit.source import Span


class Severity(enum.Enum):
    """The weight of a finding. An error stops the compiler before its next stage, a warning never
    does, and a note reports a fact, such as a proof or its absence.
    """

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


@dataclass(frozen=True)
class Label:
    """A remark attached to a place."""

    span: Span
    text: str


@dataclass(frozen=True)
class Edit:
    """Replace the text at `span` by `replacement`. An empty span inserts the text."""

    span: Span
    replacement: str


@dataclass(frozen=True)
class Fix:
    """Edits that together remove the finding."""

    title: str
    edits: tuple[Edit, ...]


@dataclass(frozen=True)
class Diagnostic:
    """A finding: the mistake, its place, the reason, and the correction.

    `code` is stable and never reused (`ROSS301`), `name` is a readable name (`unit-mismatch`),
    `title` a summary in one line, `primary` the place of the mistake, `labels` are other relevant
    places, `notes` reasons, and `help` is the correction.
    """

    code: str
    name: str
    severity: Severity
    title: str
    primary: Label
    labels: tuple[Label, ...] = ()
    notes: tuple[str, ...] = ()
    help: str | None = None
    fix: Fix | None = None
