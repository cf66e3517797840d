"""Diagnostics are declared as classes beside the stage that finds them.

A class holds the texts, with `{placeholders}`; its fields hold the values:

    class UnitMismatch(Error, code="ROSS301", name="unit-mismatch"):
        title = "units do not match"
        label = "this is in {found}"
        help = "write a value in {expected}"
        found: str
        expected: str

The annotated fields are given by their names, as those of a dataclass that is frozen and takes only
keywords. No decorator makes the methods of each class: Python would compile them for some hundred
classes, whenever a command starts, and a run needs few of them or none.

A misspelt placeholder is found when the class is first used with any value, and by
`check_placeholders`, which the tests of each catalog call for every class.
"""

from __future__ import annotations

import string
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, ClassVar, NoReturn

from dslkit.diagnostics.model import Diagnostic, Fix, Label, Severity
from dslkit.source import Span

if TYPE_CHECKING:
    from typing_extensions import dataclass_transform
else:

    def dataclass_transform(**_: bool):  # noqa: D103
        return lambda kind: kind


@dataclass_transform(kw_only_default=True, frozen_default=True)
class Template:
    """The base of all declared diagnostics; use `Error`, `Warning` or `Note`."""

    severity: ClassVar[Severity]
    code: ClassVar[str]
    name: ClassVar[str]
    title: ClassVar[str]
    label: ClassVar[str] = ""
    note: ClassVar[str | None] = None
    help: ClassVar[str | None] = None
    _fields: ClassVar[frozenset[str]] = frozenset()
    _defaults: ClassVar[Mapping[str, object]] = MappingProxyType({})

    def __init_subclass__(cls, code: str = "", name: str = "", **rest: object) -> None:
        """Record the stable code, the readable name and the fields of a declared diagnostic."""
        super().__init_subclass__(**rest)
        if code:
            cls.code = code
            cls.name = name
        own = {field for field, kind in cls.__annotations__.items() if _is_field(kind)}
        bases = [base for base in cls.__bases__ if issubclass(base, Template)]
        cls._fields = frozenset(own).union(*(base._fields for base in bases))
        inherited = {name: each for base in bases for name, each in base._defaults.items()}  # noqa: SLF001
        cls._defaults = inherited | {name: vars(cls)[name] for name in own if name in vars(cls)}

    if not TYPE_CHECKING:  # mypy derives it, with the type of each field

        def __init__(self, **values: object) -> None:
            values = {**self._defaults, **values}
            if values.keys() != self._fields:
                raise TypeError(f"{type(self).__name__} has the fields {sorted(self._fields)}")
            vars(self).update(values)

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"cannot assign to field `{name}`")

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"cannot delete field `{name}`")

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and vars(self) == vars(other)

    def __hash__(self) -> int:
        return hash((type(self), frozenset(vars(self).items())))

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value!r}" for name, value in vars(self).items())
        return f"{type(self).__qualname__}({values})"

    def at(
        self,
        span: Span,
        *labels: Label,
        fix: Fix | None = None,
        help: str | None = None,
        notes: tuple[str, ...] = (),
    ) -> Diagnostic:
        """The finding at `span`; `help` and `notes` add to or replace the class's own texts."""
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
            notes=(*own_note, *notes),
            help=help if help is not None else own_help,
            fix=fix,
        )

    @classmethod
    def check_placeholders(cls) -> None:
        """Raise `ValueError` if a text names a field that the class does not have."""
        for text in (cls.title, cls.label, cls.note, cls.help):
            for _, field, _, _ in string.Formatter().parse(text or ""):
                if field is not None and field not in cls._fields:
                    raise ValueError(f"{cls.__name__}: no field named {field!r}")


class Error(Template):
    """A diagnostic that stops the compiler before its next stage."""

    severity = Severity.ERROR


class Warning(Template):
    """A diagnostic that a user may live with."""

    severity = Severity.WARNING


class Note(Template):
    """Something found out that is no fault."""

    severity = Severity.NOTE


def _is_field(annotation: object) -> bool:
    return not str(annotation).startswith(("ClassVar", "typing.ClassVar"))
