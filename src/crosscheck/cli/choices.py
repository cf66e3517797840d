"""Arguments and options of the commands."""

from __future__ import annotations

import enum
import re
from typing import Annotated

import typer

from dslkit.options import ReportFormat

Answers = Annotated[
    ReportFormat, typer.Option("--format", help="The format of findings and result.")
]


class ShowFormat(str, enum.Enum):
    """The formats in which `show` draws."""

    TEXT = "text"
    SVG = "svg"
    JSON = "json"


def ros_namespace(text: str) -> str:
    """A ROS namespace with its first slash, as in `/robot1`; empty for the global namespace."""
    name = text.strip("/")
    if name and not re.fullmatch(r"[A-Za-z]\w*(/[A-Za-z]\w*)*", name, re.ASCII):
        raise typer.BadParameter(f"`{text}` is not a ROS namespace, such as /robot1")
    return f"/{name}" if name else ""
