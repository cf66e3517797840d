"""Skills: their parameters, their conditions, and the execution of descriptions that yields
them.
"""

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
from ezskiros.skills.permits import closeness, contact, force, speed
from ezskiros.skills.uses import server, topic

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
