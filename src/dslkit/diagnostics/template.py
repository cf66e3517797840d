"""Diagnostics, declared as classes beside the stage that reports them.

A class contains the texts, with `{placeholders}`. Its fields contain the values:

    class UnitMismatch(Error, code="ROSS301", name="unit-mismatch"):
        title = "units do not match"
        label = "this is in {found}"
        help = "write a value in {expected}"
        found: str
        expected: str

Texts for other places, and for special cases, are remarks (`Remark`).
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar

from dslkit.diagnostics.fields import Wording
from dslkit.diagnostics.model import Diagnostic, Fix, Label, Severity
from dslkit.diagnostics.remark import Remark
from dslkit.source import Span


class Template(Wording):
    """The base of all declared diagnostics; use `Error`, `Warning` or `Note`."""

    worded = ("title", "label", "note", "help")
    severity: ClassVar[Severity]
    code: ClassVar[str]
    name: ClassVar[str]
    title: ClassVar[str]
    label: ClassVar[str] = ""
    note: ClassVar[str | None] = None
    help: ClassVar[str | None] = None

    def __init_subclass__(cls, code: str = "", name: str = "", **rest: object) -> None:
        """Record the stable code and the readable name of a declared diagnostic."""
        super().__init_subclass__(**rest)
        if code:
            cls.code = code
            cls.name = name

    def at(
        self,
        span: Span,
        *labels: Label,
        fix: Fix | None = None,
        help: Remark | None = None,
        notes: Iterable[Remark] = (),
    ) -> Diagnostic:
        """The finding at `span`. `help` replaces the class's own help, `notes` add to its notes."""
        values = vars(self)
        own_note = (self.note.format(**values),) if self.note else ()
        own_help = self.help.format(**values) if self.help else None
        return Diagnostic(
            code=self.code,
            name=self.name,
            severity=self.severity,
            title=self.title.format(**values),
            primary=Label(span, self.label.format(**values)),
            labels=labels,
            notes=(*own_note, *map(str, notes)),
            help=own_help if help is None else str(help),
            fix=fix,
        )


class Error(Template):
    """A diagnostic that stops the compiler before its next stage."""

    severity = Severity.ERROR


class Warning(Template):
    """A diagnostic that does not stop the compiler."""

    severity = Severity.WARNING


class Note(Template):
    """A fact that is not an error."""

    severity = Severity.NOTE
