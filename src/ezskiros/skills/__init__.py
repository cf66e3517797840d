"""Skills: their parameters, their conditions, and the run of a description that finds them out."""

from ezskiros.skills.description import (
    SkillDescription,
    abstract,
    generated,
    of_type,
    specified,
)
from ezskiros.skills.implementation import State
from ezskiros.skills.markers import (
    CONSUME,
    INFERRED,
    LOCK,
    OPTIONAL,
    OUTPUT,
    RESPECT_TYPE,
    UNSPECIFY,
    Key,
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
    "generated",
    "of_type",
    "specified",
]
