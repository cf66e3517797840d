"""Lays out the words of one statement in lines of at most 100 columns.

A statement stays on one line if it fits. Otherwise it is broken before its parts (`then`, a resume
contract, `publishes`). A part that still does not fit is broken before each `and`, `or` and action,
a condition that still does not fit before the `and`s and `or`s in its parentheses. Values of an
import share lines, and so do the operands of a long sum and the names of a long list. A comment
inside a statement ends its line.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

MAXIMUM_COLUMNS = 100
INDENTATION = "    "
_ACTIONS = 2
"""The level of actions and of outermost conditions. A comment breaks a statement up to this
level.
"""


@dataclass(frozen=True)
class Break:
    """A place where a line may be broken, at `level` 1 first, then 2, and so on, with the
    indentation there. Without an indentation, the rest is deeper than the broken line. With
    `fills`, the line is broken only if the next piece does not fit.
    """

    level: int
    indent: int | None
    fills: bool = False


@dataclass(frozen=True)
class TrailingComment:
    """A comment after an atom: on the atom's line, or on lines of its own."""

    text: str
    is_trailing: bool


@dataclass(frozen=True)
class Atom:
    """A word or sign, with the properties of its surroundings."""

    text: str
    is_glued: bool
    break_before: Break | None = None
    comments: tuple[TrailingComment, ...] = ()


_Piece = tuple[Sequence[Atom], int]
"""A part of a statement, and its indentation."""


def lay_out(atoms: Sequence[Atom], indent: int) -> list[str]:
    """The lines of a statement at the level `indent`."""
    breaks = (atom.break_before for atom in atoms[1:])
    levels = sorted({each.level for each in breaks if each is not None})
    return _laid(atoms, indent, 0, levels)


def _laid(atoms: Sequence[Atom], indent: int, extra: int, levels: Sequence[int]) -> list[str]:
    """The lines of a part of a statement, broken at the first levels that are enough."""
    lines = _commented(atoms, indent + extra, indent + max(extra, _ACTIONS))
    is_short = max(map(len, lines)) <= MAXIMUM_COLUMNS
    if _fits(atoms, indent + extra) or not levels or (levels[0] > _ACTIONS and is_short):
        return lines
    level, *finer = levels
    pieces = _filled(_split(atoms, level, extra), indent)
    return [line for piece, depth in pieces for line in _laid(piece, indent, depth, finer)]


def _filled(pieces: Sequence[_Piece], indent: int) -> list[_Piece]:
    """The pieces. Pieces are joined to the piece before them while they fit."""
    found: list[_Piece] = []
    for atoms, extra in pieces:
        begin = atoms[0].break_before
        if found and begin is not None and begin.fills:
            joined, depth = [*found[-1][0], *atoms], found[-1][1]
            if _fits(joined, indent + depth):
                found[-1] = (joined, depth)
                continue
        found.append((atoms, extra))
    return found


def indented(text: str, indent: int) -> list[str]:
    """Each line of a text, moved to the right; empty lines stay empty."""
    return [f"{INDENTATION * indent}{line}".rstrip() for line in text.split("\n")]


def _split(atoms: Sequence[Atom], level: int, indent: int) -> list[_Piece]:
    """The pieces between the breaks of a level, each with the indentation of the break before
    it.
    """
    starts = [0]
    indents = [indent]
    for index, atom in enumerate(atoms):
        if index and atom.break_before is not None and atom.break_before.level == level:
            starts.append(index)
            its_indent = atom.break_before.indent
            indents.append(max(indent + 1, _ACTIONS) if its_indent is None else its_indent)
    ends = [*starts[1:], len(atoms)]
    pieces = zip(starts, ends, indents, strict=True)
    return [(atoms[start:end], depth) for start, end, depth in pieces]


def _commented(atoms: Sequence[Atom], indent: int, continuation: int) -> list[str]:
    """One line, broken after each comment."""
    lines = []
    start = 0
    for index, atom in enumerate(atoms):
        if not atom.comments and index + 1 < len(atoms):
            continue
        lines.append(_line(atoms[start : index + 1], indent))
        for comment in atom.comments:
            if comment.is_trailing:
                lines[-1] += f"  {comment.text}"
            else:
                lines += indented(comment.text, continuation)
        start = index + 1
        indent = continuation
    return lines


def _fits(atoms: Sequence[Atom], indent: int) -> bool:
    if any(atom.comments for atom in atoms):
        return False
    width = sum(len(atom.text) + (not atom.is_glued) for atom in atoms)
    return len(INDENTATION) * indent + width - (not atoms[0].is_glued) <= MAXIMUM_COLUMNS


def _line(atoms: Sequence[Atom], indent: int) -> str:
    rest = (atom.text if atom.is_glued else f" {atom.text}" for atom in atoms[1:])
    return INDENTATION * indent + atoms[0].text + "".join(rest)
