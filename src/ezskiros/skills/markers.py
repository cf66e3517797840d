"""What stands around the type of a parameter: `Robot: INFERRED[cora.Robot]`."""

from __future__ import annotations

import enum
from typing import Annotated, TypeVar

T = TypeVar("T")


class Kind(enum.Enum):
    """Where the value of a parameter comes from."""

    REQUIRED = "Required"
    INFERRED = "Inferred"
    OPTIONAL = "Optional"


class Option(enum.Enum):
    """What a skill does with the thing that a parameter stands for."""

    CONSUME = "Consume"
    UNSPECIFY = "Unspecify"
    LOCK = "Lock"
    RESPECT_TYPE = "RespectType"


INFERRED = Annotated[T, Kind.INFERRED]
"""Found in the world by the pre-conditions, unless it is given."""
OPTIONAL = Annotated[T, Kind.OPTIONAL]
"""May stay without a value; what the skill finds out is one."""
CONSUME = Annotated[T, Option.CONSUME]
"""The thing is not there any more after the skill."""
UNSPECIFY = Annotated[T, Option.UNSPECIFY]
"""The parameter stands for nothing any more after the skill."""
LOCK = Annotated[T, Option.LOCK]
"""The thing is idle before and after the skill, and is busy meanwhile."""
RESPECT_TYPE = Annotated[T, Option.RESPECT_TYPE]
"""Only a thing of this class will do when it is inferred."""
