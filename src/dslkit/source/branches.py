"""The conditions of `if`, `while`, `for` and `assert`. Python gives the position of the whole
statement instead.
"""

from __future__ import annotations

import ast
from functools import lru_cache

from dslkit.source.call_site import node_span
from dslkit.source.file import SourceFile
from dslkit.source.span import Span

_WORDS = ("if ", "if(", "elif ", "elif(", "while ", "while(", "assert ", "assert(", "for ")
_STATEMENTS = (ast.If, ast.While, ast.Assert, ast.For)


def asked(span: Span) -> Span:
    """The span of the condition of a statement that has one; otherwise the whole span."""
    if not span.file.text.startswith(_WORDS, span.start):
        return span
    return _questions(span.file).get(span.start, span)


@lru_cache(maxsize=64)
def _questions(file: SourceFile) -> dict[int, Span]:
    """The conditions of a file, by the starts of their statements."""
    try:
        tree = ast.parse(file.text)
    except (SyntaxError, ValueError):
        return {}
    found = [node for node in ast.walk(tree) if isinstance(node, _STATEMENTS)]
    return {node_span(file, node).start: node_span(file, _question(node)) for node in found}


def _question(node: ast.If | ast.While | ast.Assert | ast.For) -> ast.expr:
    return node.iter if isinstance(node, ast.For) else node.test
