"""Docstrings with a section `Args:`, from which EzSkiROS reads the documentation of parameters."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TypeAlias

import libcst as cst

Text: TypeAlias = cst.SimpleString | cst.ConcatenatedString
_TRIPLE = ('"""', "'''")


def docstring_of(statement: cst.CSTNode) -> Text | None:
    """The text of a statement that is only a text; None for other statements."""
    match statement:
        case cst.SimpleStatementLine(
            body=[cst.Expr(value=cst.SimpleString() | cst.ConcatenatedString() as text)]
        ):
            return text
        case _:  # open: any other statement
            return None


def with_arguments(
    text: Text | None,
    code: str,
    arguments: Sequence[tuple[str, str]],
    indents: tuple[str, str],
) -> str:
    """A docstring with the text `code`, extended by arguments.

    `indents` are the indentation of its lines, and the additional indentation of arguments.
    """
    if not arguments:
        return code
    prefix, quote, inner = _parts(text)
    escape = "r" not in prefix.lower()
    indent, step = indents
    lines = [f"{indent}{step}{name}: {_escaped(doc, quote, escape)}" for name, doc in arguments]
    head = inner.rstrip()
    if not re.search(r"(?m)^\s*(Args|Arguments|Parameters):\s*$", head):
        lines.insert(0, f"{indent}Args:")
        head = f"{head}\n" if head else ""
    return f"{prefix}{quote}" + "\n".join([head, *lines, "", f"{indent}{quote}"])


def _parts(text: Text | None) -> tuple[str, str, str]:
    """The prefix, the quotes and the inside of a docstring in triple quotes."""
    if isinstance(text, cst.SimpleString) and text.quote in _TRIPLE:
        return text.prefix, text.quote, text.raw_value
    value = text.evaluated_value if text is not None else ""
    return "", '"""', _escaped(value if isinstance(value, str) else "", '"""', escape=True)


def _escaped(text: str, quote: str, escape: bool) -> str:
    if not escape:
        return text.replace(quote, quote[0])
    found = text.replace("\\", "\\\\").replace(quote, "\\" + "\\".join(quote))
    return found[:-1] + f"\\{found[-1]}" if found.endswith(quote[0]) else found
