"""Comments: kept comments of old code, and marks that a migration adds."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

import libcst as cst

from dslkit.diagnostics import Template

_MARK = re.compile(r"# EZS7\d\d: ")


def mark(template: Template) -> str:
    """The comment above an unchanged part."""
    return f"# {template.code}: {template.title.format(**vars(template))}"


def is_mark(line: cst.EmptyLine) -> bool:
    """Say whether a line is a comment of a migration."""
    return line.comment is not None and bool(_MARK.match(line.comment.value))


def without_marks(lines: Iterable[cst.EmptyLine]) -> list[cst.EmptyLine]:
    """The lines above a statement, without the comments of an earlier migration."""
    return [line for line in lines if not is_mark(line)]


def marked(
    lines: Iterable[cst.EmptyLine], templates: Iterable[Template]
) -> Sequence[cst.EmptyLine]:
    """The lines above a statement, with marks for it."""
    marks = dict.fromkeys(map(mark, templates))
    new = [cst.EmptyLine(comment=cst.Comment(text)) for text in marks]
    return [*without_marks(lines), *new]


def texts(lines: Iterable[cst.EmptyLine]) -> list[str]:
    """The comments of lines above or below a statement; blank lines are empty texts."""
    return [line.comment.value if line.comment else "" for line in without_marks(lines)]


class _Comments(cst.CSTVisitor):
    def __init__(self) -> None:
        self.found: list[str] = []

    def visit_Comment(self, node: cst.Comment) -> None:  # noqa: N802
        self.found.append(node.value)


def inner_comments(node: cst.CSTNode) -> list[str]:
    """The comments inside a statement that covers several lines."""
    visitor = _Comments()
    node.visit(visitor)
    return visitor.found
