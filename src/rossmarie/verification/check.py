"""The proof obligations of a monitor, one query at a time."""

from __future__ import annotations

from dataclasses import dataclass

Parts = tuple[tuple[str, str], ...]
"""Functions, each with what is called instead of it."""

Passes = tuple[tuple[str, int], ...]
"""Loops, each by its function and its number there, with how often they are passed through."""


@dataclass(frozen=True)
class Check:
    """A function of the program without parameters, `check_NAME`; `about` says what it shows.

    Calls go where `replaced` says. No loop is passed through more often than `loops` says of it, or
    else the program; that is shown as well, but for those in `unwound`, of which so many passes
    stand for all. About what `is_arithmetic` no SAT solver is asked as a whole: it would not end.
    """

    name: str
    about: str
    replaced: Parts = ()
    loops: Passes = ()
    unwound: Passes = ()
    is_arithmetic: bool = False


@dataclass(frozen=True)
class Written:
    """A check with the body of its function."""

    check: Check
    body: str

    def text(self) -> str:
        """The function."""
        return f"void check_{self.check.name}(void)\n{{\n{self.body}\n}}\n"
