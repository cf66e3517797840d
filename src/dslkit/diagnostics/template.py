"""Diagnostics are declared as classes beside the stage that finds them.

A class holds the texts, with `{placeholders}`; its fields hold the values:

    @dataclass(frozen=True, kw_only=True)
    class UnitMismatch(Error, code="ROSS301", name="unit-mismatch"):
        title = "units do not match"
        label = "this is in {found}"
        help = "write a value in {expected}"
        found: str
        expected: str

A misspelt placeholder is found when the class is first used with any value, and by
`check_placeholders`, which the tests of each catalog call for every class.
"""

from __future__ import annotations

import dataclasses
import string
from typing import ClassVar

from dslkit.diagnostics.model import Diagnostic, Fix, Label, Severity
from dslkit.source import Span


@dataclasses.dataclass(frozen=True, kw_only=True)
class Template:
    """The base of all declared diagnostics; use `Error`, `Warning` or `Note`."""

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
        help: str | None = None,
        notes: tuple[str, ...] = (),
    ) -> Diagnostic:
        """The finding at `span`; `help` and `notes` add to or replace the class's own texts."""
        values = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        own_note = (self.note.format(**values),) if self.note else ()
        own_help = self.help.format(**values) if self.help else None
        return Diagnostic(
            code=self.code,
            name=self.name,
            severity=self.severity,
            title=self.title.format(**values),
            primary=Label(span, self.label.format(**values)),
            labels=labels,
            notes=(*own_note, *notes),
            help=help if help is not None else own_help,
            fix=fix,
        )

    @classmethod
    def check_placeholders(cls) -> None:
        """Raise `ValueError` if a text names a field that the class does not have."""
        known = {field.name for field in dataclasses.fields(cls)}
        for text in (cls.title, cls.label, cls.note, cls.help):
            for _, field, _, _ in string.Formatter().parse(text or ""):
                if field is not None and field not in known:
                    raise ValueError(f"{cls.__name__}: no field named {field!r}")


@dataclasses.dataclass(frozen=True, kw_only=True)
class Error(Template):
    """A diagnostic that stops the compiler before its next stage."""

    severity = Severity.ERROR


@dataclasses.dataclass(frozen=True, kw_only=True)
class Warning(Template):
    """A diagnostic that a user may live with."""

    severity = Severity.WARNING


@dataclasses.dataclass(frozen=True, kw_only=True)
class Note(Template):
    """Something found out that is no fault."""

    severity = Severity.NOTE
