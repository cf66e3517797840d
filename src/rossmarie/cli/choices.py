"""The choices that options of the `rossmarie` command offer."""

from __future__ import annotations

import enum


class TargetName(str, enum.Enum):
    """The targets that `build` can generate."""

    C99 = "c99"
    PYTHON = "python"
    ROS1 = "ros1"
    ROS2 = "ros2"


class StageName(str, enum.Enum):
    """The last stage of the compiler that `dump` runs."""

    PARSE = "parse"
    CHECK = "check"
    LOWER = "lower"
    GENERATE = "generate"


class GraphFormat(str, enum.Enum):
    """The formats in which `graph` draws."""

    TEXT = "text"
    SVG = "svg"
    DOT = "dot"
    JSON = "json"


class DumpFormat(str, enum.Enum):
    """The formats in which `dump` writes."""

    TEXT = "text"
    JSON = "json"
