"""The proof obligations of a monitor, one query at a time."""

from __future__ import annotations

from dataclasses import dataclass

Parts = tuple[tuple[str, str], ...]
"""Functions, each with its replacement."""

Passes = tuple[tuple[str, int], ...]
"""Loops, each by its function and its number there, with their numbers of passes."""


@dataclass(frozen=True)
class Check:
    """A function of the program without parameters, `check_NAME`. `about` describes its obligation.

    `replaced` redirects calls. No loop has more passes than `loops` states for it, or else than the
    program does. The bounds are proved, too, except for loops in `unwound`, where so many passes
    stand for all. A check that is `is_arithmetic` is never given to a SAT solver as a whole,
    because the solver would not finish.
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
