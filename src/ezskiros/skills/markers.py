"""The markers of parameter types: `Robot: INFERRED[cora.Robot]`."""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

T = TypeVar("T")


class Kind(enum.Enum):
    """The source of a parameter's value."""

    REQUIRED = "Required"
    INFERRED = "Inferred"
    OPTIONAL = "Optional"


class Option(enum.Enum):
    """The options of a parameter: the effect of a skill on its thing."""

    CONSUME = "Consume"
    OUTPUT = "Output"
    UNSPECIFY = "Unspecify"
    LOCK = "Lock"
    RESPECT_TYPE = "RespectType"


@dataclass(frozen=True)
class Key:
    """The name of a parameter in SkiROS2, where that is no name of Python: `StartPose:
    Annotated[skiros.TransformationPose, Key("Start Pose")]`.
    """

    text: str


INFERRED = Annotated[T, Kind.INFERRED]
"""Found in the world by the pre-conditions, unless it is given."""
OPTIONAL = Annotated[T, Kind.OPTIONAL]
"""May stay without a value; what the skill finds out is one."""
CONSUME = Annotated[T, Option.CONSUME]
"""The thing is not there any more after the skill."""
OUTPUT = Annotated[T, Option.OUTPUT]
"""The skill gives it its value: there is none before."""
UNSPECIFY = Annotated[T, Option.UNSPECIFY]
"""The parameter stands for nothing any more after the skill."""
LOCK = Annotated[T, Option.LOCK]
"""The thing is idle before and after the skill, and is busy meanwhile."""
RESPECT_TYPE = Annotated[T, Option.RESPECT_TYPE]
"""Only a thing of this class will do when it is inferred."""


class NoType:
    """A mistake in the place of a type: `OPTIONAL[[1.0, 2.0]]`, or a text."""

    def __init__(self, found: object) -> None:
        self.found = found

    def __call__(self) -> None:
        """Nobody does; `typing` takes only what can be called for a type."""

    def __repr__(self) -> str:
        return repr(self.found)


class Marker:
    """A marker at run time. It accepts any argument; the user of the marker reports mistakes."""

    def __init__(self, mark: Kind | Option, found: str = "") -> None:
        self._mark, self._found = mark, found

    def __getitem__(self, found: Any) -> Any:
        return Annotated[found if callable(found) else NoType(found), self._mark]

    def __call__(self, *found: object) -> Marker:
        """The same: `INFERRED(cora.Robot)`, where `INFERRED[cora.Robot]` is meant."""
        spelled = (str(getattr(each, "__qualname__", repr(each))) for each in found)
        return Marker(self._mark, ", ".join(spelled))

    def __repr__(self) -> str:
        return self._mark.name

    @property
    def meant(self) -> str:
        """The notation of the type that is meant."""
        return f"{self._mark.name}[{self._found or '...'}]"


if not TYPE_CHECKING:
    INFERRED, OPTIONAL = Marker(Kind.INFERRED), Marker(Kind.OPTIONAL)
    CONSUME, OUTPUT, UNSPECIFY = map(Marker, (Option.CONSUME, Option.OUTPUT, Option.UNSPECIFY))
    LOCK, RESPECT_TYPE = Marker(Option.LOCK), Marker(Option.RESPECT_TYPE)
