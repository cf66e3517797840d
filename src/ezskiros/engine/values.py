"""The values of the parameters of a running skill, with their types."""

from __future__ import annotations

import difflib
import enum
from dataclasses import dataclass
from typing import Any

from ezskiros.engine.world import World
from ezskiros.skills.interface import Parameter, SkillInterface


@dataclass(frozen=True)
class WorldThing:
    """Something in the world model that a parameter stands for."""

    iri: str
    _world: World

    def __str__(self) -> str:
        return self._world.spelled(self.iri)


class Values:
    """`self.params` of a primitive: `self.params.Speed`, `self.params.Force = 3.5`."""

    def __init__(self, skill: SkillInterface, given: dict[str, Any]) -> None:
        object.__setattr__(self, "_skill", skill)
        object.__setattr__(self, "_given", given)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return self._given[self._parameter(name).name]

    def __setattr__(self, name: str, value: Any) -> None:
        parameter = self._parameter(name)
        if not fits(value, parameter):
            wanted = parameter.type.__name__
            raise WrongValueError(f"`{name}` is of type {wanted}, and {value!r} is not")
        self._given[name] = value

    def _parameter(self, name: str) -> Parameter:
        skill: SkillInterface = self._skill
        parameter = skill.parameter(name)
        if parameter is not None:
            return parameter
        near = difflib.get_close_matches(name, [each.name for each in skill.parameters], n=1)
        hint = f"; did you mean `{near[0]}`?" if near else ""
        raise AttributeError(f"`{skill.name}` has no parameter `{name}`{hint}")


class WrongValueError(TypeError):
    """A value that a parameter cannot have."""


def fits(value: Any, parameter: Parameter) -> bool:
    """Whether a parameter can have a value."""
    if parameter.is_thing:
        return isinstance(value, WorldThing)
    if parameter.type is float and type(value) is int:
        return True
    if issubclass(parameter.type, enum.Enum):
        return isinstance(value, parameter.type)
    return type(value) is parameter.type
