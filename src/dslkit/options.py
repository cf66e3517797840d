"""The options that commands of several programs share."""

from __future__ import annotations

import enum
from pathlib import Path
from typing import Annotated

import typer

StudyFile = Annotated[
    Path | None,
    typer.Option(
        "--study",
        metavar="FILE",
        help="Append the codes and locations of the findings to this study log.",
        readable=False,
    ),
]
"""The option that a check has for studies with users; without it a check keeps no record."""

Force = Annotated[
    bool, typer.Option("--force", help="Replace files that this program did not write.")
]
"""The option of every command that writes files; its first statement is `output.permit(force)`."""


class Format(str, enum.Enum):
    """The formats in which a check prints its findings."""

    TEXT = "text"
    JSON = "json"
    SARIF = "sarif"


class ReportFormat(str, enum.Enum):
    """The formats in which the other commands print their findings and their result."""

    TEXT = "text"
    JSON = "json"
