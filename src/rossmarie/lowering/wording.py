"""The user's own words, on one line: what verdicts and generated comments show."""

from __future__ import annotations

import re

from dslkit.source import Span

# A text literal, which has no escapes, is kept as it is; any run of white space and comments
# becomes one blank.
_PIECE = re.compile(
    r"""(?P<literal>"[^"\n]*")|(?:\s|//[^\n]*|'''.*?''')+""",
    re.DOTALL,
)


def words(span: Span) -> str:
    """The text at a span, without comments and line breaks."""
    return _PIECE.sub(lambda piece: piece["literal"] or " ", span.text).strip()
