"""The markers of parameter types: `Robot: INFERRED[cora.Robot]`."""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

T = TypeVar("T")


class ParameterKind(enum.Enum):
    """The source of a parameter's value."""

    REQUIRED = "Required"
    INFERRED = "Inferred"
    OPTIONAL = "Optional"


class Option(enum.Enum):
    """The options of a parameter: the effect of a skill on its individual."""

    CONSUME = "Consume"
    OUTPUT = "Output"
    UNSPECIFY = "Unspecify"
    LOCK = "Lock"
    RESPECT_TYPE = "RespectType"


@dataclass(frozen=True)
class Key:
    """The SkiROS2 key of a parameter, if it is not a valid Python name: `StartPose:
    Annotated[skiros.TransformationPose, Key("Start Pose")]`.
    """

    text: str


INFERRED = Annotated[T, ParameterKind.INFERRED]
"""The value is inferred from the world by the pre-conditions, unless it is given."""
OPTIONAL = Annotated[T, ParameterKind.OPTIONAL]
"""The parameter may have no value. A value that the skill sets is optional as well."""
CONSUME = Annotated[T, Option.CONSUME]
"""The individual does not exist after the skill."""
OUTPUT = Annotated[T, Option.OUTPUT]
"""The skill sets the value. There is no value before the skill."""
UNSPECIFY = Annotated[T, Option.UNSPECIFY]
"""The parameter has no value after the skill."""
LOCK = Annotated[T, Option.LOCK]
"""The individual is idle before and after the skill, and busy during it."""
RESPECT_TYPE = Annotated[T, Option.RESPECT_TYPE]
"""The inferred individual must be of exactly this class."""


class NoType:
    """An invalid type, such as `OPTIONAL[[1.0, 2.0]]`, or a text."""

    def __init__(self, found: object) -> None:
        self.found = found

    def __call__(self) -> None:
        """Never called. `typing` requires that types are callable."""

    def __repr__(self) -> str:
        return repr(self.found)


class Marker:
    """A marker at run time. It accepts any argument; the user of the marker reports mistakes."""

    def __init__(self, mark: ParameterKind | Option, found: str = "") -> None:
        self._mark, self._found = mark, found

    def __getitem__(self, found: Any) -> Any:
        return Annotated[found if callable(found) else NoType(found), self._mark]

    def __call__(self, *found: object) -> Marker:
        """Handle `INFERRED(cora.Robot)` like `INFERRED[cora.Robot]`."""
        spelled = (str(getattr(each, "__qualname__", repr(each))) for each in found)
        return Marker(self._mark, ", ".join(spelled))

    def __repr__(self) -> str:
        return self._mark.name

    @property
    def meant(self) -> str:
        """The intended notation of the type."""
        return f"{self._mark.name}[{self._found or '...'}]"


if not TYPE_CHECKING:
    INFERRED, OPTIONAL = Marker(ParameterKind.INFERRED), Marker(ParameterKind.OPTIONAL)
    CONSUME, OUTPUT, UNSPECIFY = map(Marker, (Option.CONSUME, Option.OUTPUT, Option.UNSPECIFY))
    LOCK, RESPECT_TYPE = Marker(Option.LOCK), Marker(Option.RESPECT_TYPE)
