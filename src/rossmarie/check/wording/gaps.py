"""Signs and words between two parts of the tree that are not nodes of the tree."""

from __future__ import annotations

from dslkit.diagnostics import Edit
from dslkit.source import SourceFile, Span
from rossmarie.syntax.scan import scan


def without(before: Span, sign: str, part: Span) -> tuple[Edit, ...]:
    """The edits that remove `part` and the `sign` between `part` and the part `before` it.

    Comments between the two parts stay, and so does white space that does not surround the sign.
    """
    file, start = part.file, before.end
    gap = file.text[start : part.start]
    tokens = [token for token in scan(SourceFile(file.path, gap)).tokens if token.text == sign]
    if not tokens:
        return (Edit(part, ""),)
    first, end = tokens[-1].start, tokens[-1].end
    if gap[first - 1 : first] == " ":
        first -= 1
    if gap[end:].isspace() or end == len(gap):
        return (Edit(Span(file, start + first, part.end), ""),)
    return (Edit(Span(file, start + first, start + end), ""), Edit(part, ""))
