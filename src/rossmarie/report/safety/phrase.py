"""A sentence about a machine: words, and what a list below them says."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from dslkit.source import Span


@dataclass(frozen=True)
class Phrase:
    """Words; if they end in a colon, `parts` is what they announce.

    `span` is where the rules say so, `name` what they call it. `refers_to` is the anchor of the
    place in the page that says it in full.
    """

    text: str
    parts: tuple[Phrase, ...] = ()
    span: Span | None = None
    name: str | None = None
    refers_to: str | None = None

    def lines(self, depth: int = 0) -> Iterator[str]:
        """The words as indented lines."""
        yield f"{'  ' * depth}- {self.text}"
        for part in self.parts:
            yield from part.lines(depth + 1)


def listed(words: tuple[str, ...], junction: str = "and") -> str:
    """`a`, `a and b`, `a, b and c`."""
    if len(words) < 2:
        return "".join(words)
    return f"{', '.join(words[:-1])} {junction} {words[-1]}"
