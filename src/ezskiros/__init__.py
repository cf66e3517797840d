"""Skills for SkiROS2 as typed Python: checked against the ontology before the robot is launched."""

from __future__ import annotations

TYPE_CHECKING = False  # not from `typing`: Ctrl-C during its import prints a traceback
if TYPE_CHECKING:
    from ezskiros.skills import (
        CONSUME,
        INFERRED,
        LOCK,
        OPTIONAL,
        OUTPUT,
        RESPECT_TYPE,
        UNSPECIFY,
        Key,
        SkillDescription,
        State,
        abstract,
        closeness,
        contact,
        force,
        generated,
        of_type,
        server,
        specified,
        speed,
        topic,
    )

__all__ = [
    "CONSUME",
    "INFERRED",
    "LOCK",
    "OPTIONAL",
    "OUTPUT",
    "RESPECT_TYPE",
    "UNSPECIFY",
    "Key",
    "SkillDescription",
    "State",
    "abstract",
    "closeness",
    "contact",
    "force",
    "generated",
    "of_type",
    "server",
    "specified",
    "speed",
    "topic",
]


def __getattr__(name: str) -> object:
    """Import the names for skills on first use, because every subpackage imports this module."""
    if name in __all__:
        from ezskiros import skills

        return getattr(skills, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
