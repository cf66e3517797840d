"""What is to be shown of a monitor, one question at a time."""

from __future__ import annotations

from dataclasses import dataclass

Parts = tuple[tuple[str, str], ...]
"""Functions, each with what is called instead of it."""


@dataclass(frozen=True)
class Check:
    """A function of the program without parameters, `check_NAME`; `about` says what it shows.

    Calls go where `replaced` says. No loop is passed through more often
    than the program allows (that is shown as well), but for those in `unwound`, of which so many
    passes stand for all.
    """

    name: str
    about: str
    replaced: Parts = ()
    unwound: tuple[tuple[str, int], ...] = ()


@dataclass(frozen=True)
class Written:
    """A check with the body of its function."""

    check: Check
    body: str

    def text(self) -> str:
        """The function."""
        return f"void check_{self.check.name}(void)\n{{\n{self.body}\n}}\n"
