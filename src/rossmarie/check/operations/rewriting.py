"""Fixes that replace an expression."""

from __future__ import annotations

from dslkit.diagnostics import Edit, Fix
from rossmarie.check.scopes.context import Context
from rossmarie.check.scopes.trees import quoted
from rossmarie.syntax import ast


def rewritten(node: ast.Expression, meant: str, context: Context) -> Fix:
    """The fix that writes `meant` instead of `node`, in parentheses if an expression surrounds
    it.
    """
    around = context.parents.get(node)
    is_alone = around is None or isinstance(around, ast.Parenthesized)
    text = meant if is_alone else f"({meant})"
    return Fix(f"write `{quoted(text)}`", (Edit(node.span, text),))
