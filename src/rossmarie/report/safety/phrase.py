"""A sentence about a machine: words, and a list below them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from dslkit.source import Span


@dataclass(frozen=True)
class Phrase:
    """Words. If they end in a colon, `parts` is the list after it.

    `span` is the place in the rules, `name` the name there. `refers_to` is the anchor of the full
    description in the page.
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
