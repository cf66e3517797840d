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

    `replaced` redirects calls. `loops` limits the passes of the loops that it names; the limit of
    the program applies to all other loops. CBMC also proves that the limits are enough, except for
    the loops in `unwound`, where the given number of passes stands for any number. A check with
    `is_arithmetic` is never given to a SAT solver as a whole, because the solver would not finish.
    """

    name: str
    about: str
    replaced: Parts = ()
    loops: Passes = ()
    unwound: Passes = ()
    is_arithmetic: bool = False


@dataclass(frozen=True)
class WrittenCheck:
    """A check with the body of its function."""

    check: Check
    body: str

    def text(self) -> str:
        """The function."""
        return f"void check_{self.check.name}(void)\n{{\n{self.body}\n}}\n"
