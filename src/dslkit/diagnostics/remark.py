"""Remarks: additional texts of a finding, at other places or for special cases.

Declare a remark beside its diagnostic, usually inside the class of the diagnostic:

    class UndeclaredName(Error, code="ROSS101", name="undeclared-name"):
        title = "`{identifier}` is not declared"
        help = "declare it"
        identifier: str

        class Near(Remark):
            says = "`{near}` is declared here"
            near: str

A remark becomes the label of a place, `UndeclaredName.Near(near=name).at(span)`, or a help or a
note, if it is passed to `at` of the diagnostic.
"""

from __future__ import annotations

from dataclasses import replace
from typing import ClassVar

from dslkit.diagnostics.fields import Wording
from dslkit.diagnostics.model import Diagnostic, Label
from dslkit.source import Span


class Remark(Wording):
    """The base of all remarks."""

    worded = ("says",)
    says: ClassVar[str]

    def __str__(self) -> str:
        return self.says.format(**vars(self))

    def at(self, span: Span) -> Label:
        """The label of a place."""
        return Label(span, str(self))


def remarked(found: Diagnostic, *notes: Remark, help: Remark | None = None) -> Diagnostic:
    """A finding with additional notes, and with another help if one is given."""
    more = (*found.notes, *map(str, notes))
    return replace(found, notes=more, help=found.help if help is None else str(help))


class DidYouMean(Remark):
    """The help for a misspelt name."""

    says = "did you mean `{near}`?"
    near: str


class Write(Remark):
    """The help that gives the correct text."""

    says = "write `{meant}`"
    meant: str


class DeclaredHere(Remark):
    """The label of a declaration."""

    says = "declared here"


class NamedHere(Remark):
    """The label of the declaration of one of several names."""

    says = "`{name}` is declared here"
    name: str
