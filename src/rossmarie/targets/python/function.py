"""A function of the generated module during writing: its lines, and the variables that it
assigns.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterable

INDENT = "    "


class StartFunction:
    """One function inside `start`. It shares the variables of `start`. Depths count
    indentations.
    """

    def __init__(self, head: str) -> None:
        self.head = head
        self._lines: list[str] = []
        self._shared: dict[str, None] = {}

    def line(self, text: str, depth: int = 0) -> None:
        """Add a line."""
        self._lines.append(INDENT * depth + text)

    def assign(self, variable: str, value: str, depth: int = 0) -> None:
        """Assign a value to a variable of `start`."""
        self._shared[variable] = None
        self.line(f"{variable} = {value}", depth)

    def take(self, other: StartFunction) -> None:
        """Add the lines and assignments of another function to this function."""
        self._lines += other._lines
        self._shared.update(other._shared)

    @property
    def length(self) -> int:
        """The number of lines."""
        return len(self._lines)

    def text(self) -> list[str]:
        """The function as lines, indented once."""
        shared = [f"nonlocal {names}" for names in _wrapped(self._shared)]
        body = [*shared, *self._lines] or ["pass"]
        return [
            f"{INDENT}def {self.head}:",
            *(f"{INDENT}{INDENT}{line}" if line else "" for line in body),
            "",
        ]


def _wrapped(names: Iterable[str]) -> list[str]:
    lines = textwrap.wrap(", ".join(names), 78)
    return [line.rstrip(",") for line in lines]
