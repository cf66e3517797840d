"""Printing of behavior trees."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console

from ezskiros.drawing.outline import Outline
from ezskiros.drawing.terminal import terminal_tree

_WIDE = 10_000


def console_for_outlines() -> Console:
    """The console for trees. It breaks lines only if the width of a terminal is known."""
    console = Console(highlight=False)
    if not console.is_terminal:
        return plain_console()
    return Console(highlight=False, width=console.width, force_terminal=True)


def plain_console() -> Console:
    """The console for text in a file, which breaks no line."""
    return Console(highlight=False, width=_WIDE)


def outlines_text(outlines: Sequence[Outline], console: Console) -> str:
    """Some trees as the text that a console prints, including colours."""
    with console.capture() as captured:
        for number, found in enumerate(outlines):
            if number:
                console.print()
            console.print(terminal_tree(found))
    return captured.get()
