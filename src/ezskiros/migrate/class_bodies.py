"""The lines in the body of an implementation class: its comments, and marks above them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import libcst as cst

from dslkit.diagnostics import Template
from ezskiros.migrate.comments import marked
from ezskiros.migrate.description import UntranslatedPart
from ezskiros.migrate.docstrings import Text


def with_lines(part: cst.CSTNode, comments: Sequence[str], *, is_first: bool) -> cst.CSTNode:
    """A part of a class with more comments above it. The first part has no blank lines above it."""
    own_lines = list(part.leading_lines)  # type: ignore[attr-defined]
    while is_first and own_lines and own_lines[0].comment is None:
        own_lines.pop(0)
    blank = [] if is_first or not comments else [cst.EmptyLine(indent=False)]
    lines = [*blank, *empty_lines(comments), *own_lines]
    return part.with_changes(leading_lines=lines)


def empty_lines(comments: Sequence[str]) -> list[cst.EmptyLine]:
    """Lines that contain only comments."""
    return [cst.EmptyLine(comment=cst.Comment(each)) for each in comments]


def behind(part: cst.CSTNode) -> list[str]:
    """The comment at the end of a one-line statement."""
    comment = getattr(getattr(part, "trailing_whitespace", None), "comment", None)
    return [comment.value] if comment else []


def lines_of(text: Text) -> list[str]:
    """The lines of a docstring."""
    value = text.evaluated_value
    return value.strip().splitlines() if isinstance(value, str) else []


class _Marks(cst.CSTTransformer):
    """Puts marks above statements, and replaces existing ones."""

    def __init__(self, templates: Mapping[int, Sequence[Template]]) -> None:
        self._templates = templates

    def on_leave(  # type: ignore[override]
        self, original_node: cst.CSTNode, updated_node: cst.CSTNode
    ) -> cst.CSTNode | cst.RemovalSentinel | cst.FlattenSentinel[cst.CSTNode]:
        if not isinstance(original_node, (cst.SimpleStatementLine, cst.BaseCompoundStatement)):
            return updated_node
        lines = getattr(updated_node, "leading_lines", None)
        if lines is None:  # `elif`
            return updated_node
        new = marked(lines, self._templates.get(id(original_node), ()))
        return updated_node.with_changes(leading_lines=new)


def with_marks(node: cst.ClassDef, findings: Sequence[UntranslatedPart]) -> cst.ClassDef:
    """A class that stays unchanged, with a comment above each statement without a translation."""
    templates: dict[int, list[Template]] = {}
    for finding in findings:
        templates.setdefault(id(finding.statement), []).append(finding.template)
    found = node.visit(_Marks(templates))
    assert isinstance(found, cst.ClassDef)
    return found


def without_old_marks(part: cst.CSTNode) -> cst.CSTNode:
    """A part of a class, without the marks of an earlier migration."""
    found = part.visit(_Marks({}))
    assert isinstance(found, cst.CSTNode)
    return found


def switch(name: str, comments: Sequence[str], *, is_first: bool) -> cst.SimpleStatementLine:
    """The line `name = False` of a class, with comments above it."""
    value = cst.Assign([cst.AssignTarget(cst.Name(name))], cst.Name("False"))
    blank = [] if is_first else [cst.EmptyLine(indent=False)]
    return cst.SimpleStatementLine([value], leading_lines=[*blank, *empty_lines(comments)])
