"""A behavior tree for a terminal. `cli` prints it."""

from __future__ import annotations

from rich.text import Text
from rich.tree import Tree as RichTree

from ezskiros.drawing.outline import Line, NodeBox, Outline, Role

_BESIDE = 70
"""The most characters of arguments beside the title. Longer arguments are below the title, one on
each line.
"""
_STYLES = {
    Role.PASSED: "cyan",
    Role.VALUE: "magenta",
    Role.PRE: "dim",
    Role.HOLD: "dim",
    Role.POST: "dim",
}


def terminal_tree(found: Outline) -> RichTree:
    """A tree for rich, with the answers that lead to it above."""
    drawn = RichTree(_text(found.root), highlight=False)
    for child in found.root.children:
        _hang(child, drawn)
    if not found.branch:
        return drawn
    above = RichTree(Text("if " + " and ".join(found.branch), style="yellow"))
    above.children.append(drawn)
    return above


def _hang(box: NodeBox, above: RichTree) -> None:
    here = above.add(_text(box))
    for child in box.children:
        _hang(child, here)


def _text(box: NodeBox) -> Text:
    """The text of a box: the title, the arguments beside or below it, and the conditions."""
    found = Text()
    if box.token:
        found.append(f"{box.token} ", "bold yellow")
    found.append(box.title, "" if box.token else "bold")
    arguments = [line for line in box.lines if not line.role.is_condition]
    is_long = sum(len(line.text) + 2 for line in arguments) > _BESIDE
    for number, line in enumerate(arguments):
        found.append("\n     " if is_long else ", " if number else "  ")
        found.append(line.text, _STYLES[line.role])
    for line in box.lines:
        if line.role.is_condition:
            _condition(line, found)
    return found


def _condition(line: Line, text: Text) -> None:
    text.append(f"\n{line.role.value:<4} {line.text}", _STYLES[line.role])
