"""How behavior trees are printed."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console

from ezskiros.drawing.outline import Outline
from ezskiros.drawing.terminal import terminal_tree

_WIDE = 10_000


def print_outlines(outlines: Sequence[Outline]) -> None:
    """Print some trees; lines are broken only where a terminal says how wide it is."""
    console = Console(highlight=False)
    if not console.is_terminal:
        console = Console(highlight=False, width=_WIDE)
    for number, found in enumerate(outlines):
        if number:
            console.print()
        console.print(terminal_tree(found))
