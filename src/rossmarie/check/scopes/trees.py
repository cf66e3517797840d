"""Queries about syntax trees that need no types."""

from __future__ import annotations

from rossmarie.check.scopes.declarations import ProgramDeclarations
from rossmarie.syntax import ast

LONGEST_QUOTE = 160


def text_of(node: ast.Expression) -> str:
    """The text that the user wrote, as `quoted`."""
    return quoted(node.span.text)


def quoted(text: str) -> str:
    """A text of the user on one line. A long text is shortened in the middle."""
    line = " ".join(text.split())
    half = LONGEST_QUOTE // 2
    return line if len(line) <= LONGEST_QUOTE else f"{line[:half]} ... {line[-half:]}"


def stripped(node: ast.Expression) -> ast.Expression:
    """The expression inside any parentheses."""
    while isinstance(node, ast.Parenthesized):
        node = node.inner
    return node


def root_of(node: ast.Expression) -> ast.Reference | None:
    """The name at the beginning of a chain of fields and indices."""
    while isinstance(node, ast.Parenthesized | ast.Member | ast.Index | ast.Sector):
        node = node.inner if isinstance(node, ast.Parenthesized) else node.value
    return node if isinstance(node, ast.Reference) else None


def constant_of(node: ast.Expression, declarations: ProgramDeclarations) -> ast.Constant | None:
    """The declaration that a reference to a constant stands for."""
    if not isinstance(node, ast.Reference):
        return None
    found = declarations.names.get(node.name.text)
    return found if isinstance(found, ast.Constant) else None


def literal_of(
    node: ast.Expression, declarations: ProgramDeclarations
) -> ast.Number | ast.Bracket | None:
    """The literal number or range of a constant: here, or at its declaration.

    The constants must not be circular.
    """
    inner = stripped(node)
    constant = constant_of(inner, declarations)
    while constant is not None:
        inner = stripped(constant.value)
        constant = constant_of(inner, declarations)
    while isinstance(inner, ast.Unary) and inner.operator is ast.UnaryOperator.NEGATE:
        inner = stripped(inner.operand)
    return inner if isinstance(inner, ast.Number | ast.Bracket) else None


def path_of(node: ast.Expression) -> tuple[str, ...]:
    """The fields in a chain of fields and indices, in order."""
    path: list[str] = []
    while isinstance(node, ast.Parenthesized | ast.Member | ast.Index | ast.Sector):
        if isinstance(node, ast.Member):
            path.insert(0, node.member.text)
        node = node.inner if isinstance(node, ast.Parenthesized) else node.value
    return tuple(path)
