"""What options of the `rossmarie` command choose from."""

from __future__ import annotations

import enum


class TargetName(str, enum.Enum):
    """What `build` can generate."""

    C99 = "c99"
    PYTHON = "python"
    ROS1 = "ros1"
    ROS2 = "ros2"


class StageName(str, enum.Enum):
    """Where `dump` stops."""

    PARSE = "parse"
    CHECK = "check"
    LOWER = "lower"
    GENERATE = "generate"


class GraphFormat(str, enum.Enum):
    """How `graph` draws."""

    TEXT = "text"
    SVG = "svg"
    DOT = "dot"


class DumpFormat(str, enum.Enum):
    """How `dump` writes."""

    TEXT = "text"
    JSON = "json"
