"""Skills for SkiROS2 as typed Python: checked against the ontology before the robot is launched."""

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
    abstract,
    generated,
    of_type,
    specified,
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
    "abstract",
    "generated",
    "of_type",
    "specified",
]
