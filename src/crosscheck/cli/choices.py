"""Arguments and options of `crosscheck live`."""

from __future__ import annotations

import enum
import re

import typer


class LiveFormat(str, enum.Enum):
    """The format in which a robot that runs is told of."""

    TEXT = "text"
    JSON = "json"


def ros_namespace(text: str) -> str:
    """A namespace of ROS with its first slash, as in `/robot1`; empty for that of all."""
    name = text.strip("/")
    if name and not re.fullmatch(r"[A-Za-z]\w*(/[A-Za-z]\w*)*", name, re.ASCII):
        raise typer.BadParameter(f"`{text}` is no namespace of ROS, such as /robot1")
    return f"/{name}" if name else ""
