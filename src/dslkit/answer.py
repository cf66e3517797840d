"""The answer of a command for other programs: findings and a result, printed as one JSON object.

`docs/reference/json-output.md` describes the object.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # not needed by a command that prints text
    from dslkit.diagnostics import Diagnostic
    from dslkit.diagnostics.render_json import Json


@dataclass
class Answer:
    """The answer of one run of a command.

    `command` is the program with the name of the command, `files` the number of files that the user
    named. If `is_printed` is False, the command prints text instead, and nothing is collected.
    `result` is the output of the command, None if there is none; `error` is the reason why the
    command ended before it had one.
    """

    command: str
    files: int
    is_printed: bool
    result: Json = None
    error: str | None = None
    found: list[Diagnostic] = field(default_factory=list)

    def add(self, found: Sequence[Diagnostic]) -> None:
        """Add findings."""
        self.found += found

    def text(self) -> str:
        """The JSON object, with a final newline."""
        from dslkit.diagnostics.render_json import render_json

        return render_json(
            self.found,
            command=self.command,
            file_count=self.files,
            result=self.result,
            error=self.error,
        )
