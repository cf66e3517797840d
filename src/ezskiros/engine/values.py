"""The values of the parameters of a running skill, with their types."""

from __future__ import annotations

import difflib
import enum
from dataclasses import dataclass
from typing import Any

from ezskiros.engine.world import World
from ezskiros.skills.interface import Parameter, SkillInterface


@dataclass(frozen=True)
class WorldIndividual:
    """An individual of the world model, as the value of a parameter. Its text is its name, such as
    `skiros:Location-3`.
    """

    iri: str
    _world: World

    @property
    def label(self) -> str | None:
        """The label of the individual in the world model (rdfs:label)."""
        return self._world.label(self.iri)

    def __str__(self) -> str:
        return self._world.spelled(self.iri)

    __repr__ = __str__


class WrongValueError(TypeError):
    """An invalid value for a parameter."""


class Values:
    """`self.params` of a primitive: `self.params.Speed`, `self.params.Force = 3.5`.

    Raises `AttributeError` for a parameter that the skill does not have, and `WrongValueError` for
    a value of another type.
    """

    def __init__(self, skill: SkillInterface, given: dict[str, Any]) -> None:
        vars(self).update(_skill=skill, _given=given, _is_changed=False)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        if name in self._given:
            return self._given[name]
        raise AttributeError(self._unknown(name))

    def __setattr__(self, name: str, value: Any) -> None:
        skill: SkillInterface = self._skill
        parameter = skill.parameter(name)
        if parameter is None:
            raise AttributeError(self._unknown(name))
        if not fits(value, parameter):
            raise WrongValueError(
                f"`{name}` must be {wanted(parameter)}, but the value is {value!r}"
            )
        self._given[name] = float(value) if parameter.type is float else value
        vars(self)["_is_changed"] = True

    def __getitem__(self, name: object) -> None:
        raise TypeError(f"write `self.params.{name}`")

    def is_changed(self) -> bool:
        """Say whether the skill has set a value."""
        return bool(self._is_changed)

    def _unknown(self, name: str) -> str:
        skill: SkillInterface = self._skill
        near = difflib.get_close_matches(name, [each.name for each in skill.parameters], n=1)
        hint = f"; did you mean `{near[0]}`?" if near else ""
        return f"`{skill.name}` has no parameter `{name}`{hint}"


def fits(value: Any, parameter: Parameter) -> bool:
    """Say whether a parameter can have a value. None means that there is no value."""
    if value is None:
        return parameter.is_individual
    if isinstance(value, WorldIndividual):
        return parameter.iri is not None and value._world.is_a(value.iri, parameter.iri)  # noqa: SLF001
    if parameter.is_individual:
        return False
    if parameter.type is float and type(value) is int:
        return True
    if issubclass(parameter.type, enum.Enum):
        return isinstance(value, parameter.type)
    return type(value) is parameter.type


def wanted(parameter: Parameter) -> str:
    """Describe the valid values of a parameter, for messages."""
    if parameter.is_individual:
        return f"a {parameter.type!r}"
    if issubclass(parameter.type, enum.Enum):
        return f"one of {', '.join(each.name for each in parameter.type)}"
    article = "an" if parameter.type is int else "a"
    return f"{article} {parameter.type.__name__}"
