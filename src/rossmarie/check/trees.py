"""Questions about syntax trees that need no types."""

from __future__ import annotations

from rossmarie.check.declarations import Declarations
from rossmarie.syntax import ast

LONGEST_QUOTE = 160


def text_of(node: ast.Expression) -> str:
    """What the user wrote, as `quoted`."""
    return quoted(node.span.text)


def quoted(text: str) -> str:
    """A text of the user on one line; of a long one, the beginning and the end."""
    line = " ".join(text.split())
    half = LONGEST_QUOTE // 2
    return line if len(line) <= LONGEST_QUOTE else f"{line[:half]} ... {line[-half:]}"


def stripped(node: ast.Expression) -> ast.Expression:
    """The expression inside any parentheses."""
    while isinstance(node, ast.Parenthesized):
        node = node.inner
    return node


def root_of(node: ast.Expression) -> ast.Reference | None:
    """The name that a chain of fields and indices starts from."""
    while isinstance(node, ast.Parenthesized | ast.Member | ast.Index):
        node = node.inner if isinstance(node, ast.Parenthesized) else node.value
    return node if isinstance(node, ast.Reference) else None


def constant_of(node: ast.Expression, declarations: Declarations) -> ast.Constant | None:
    """The declaration that a reference to a constant stands for."""
    if not isinstance(node, ast.Reference):
        return None
    found = declarations.names.get(node.name.text)
    return found if isinstance(found, ast.Constant) else None


def literal_of(node: ast.Expression, declarations: Declarations) -> ast.Number | None:
    """The number as written that a constant stands for: here, or in its declaration."""
    constant = constant_of(stripped(node), declarations)
    inner = stripped(node if constant is None else constant.value)
    while isinstance(inner, ast.Unary) and inner.operator is ast.UnaryOperator.NEGATE:
        inner = stripped(inner.operand)
    return inner if isinstance(inner, ast.Number) else None
