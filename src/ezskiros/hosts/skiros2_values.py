"""The values of parameters in SkiROS2, with the same types as in the engine. Individuals are also
SkiROS2 elements.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ezskiros.engine.values import Values, WorldIndividual
from ezskiros.hosts.skiros2_api import api
from ezskiros.hosts.skiros2_tree import lowered, raised
from ezskiros.hosts.skiros2_world import HostedWorld
from ezskiros.skills.interface import Parameter, SkillInterface


class HostedIndividual(WorldIndividual):
    """An individual with all methods of SkiROS2's `Element`, such as
    `individual.getData("skiros:Position")`.
    """

    def __init__(self, element: Any, world: HostedWorld) -> None:
        super().__init__(world.iri(element.id), world)
        object.__setattr__(self, "element", element)
        object.__setattr__(self, "_before", _said(element))

    def __getattr__(self, name: str) -> Any:
        if name == "element" or name.startswith("__"):
            raise AttributeError(name)
        return getattr(self.element, name)

    @property
    def is_changed(self) -> bool:
        """Say whether the element has changed since the skill got it."""
        return bool(self._before != _said(self.element))


def _said(element: Any) -> object:
    """The statements about an element."""
    properties = {each.key: list(each.values) for each in element.properties}
    return properties, [dict(each) for each in element.getRelations()]


class HostedValues(Values):
    """`self.params` in SkiROS2. Individuals can be set to elements, including new ones."""

    def __init__(self, skill: SkillInterface, given: dict[str, Any]) -> None:
        super().__init__(skill, given)
        object.__setattr__(self, "found_out", {})

    def __setattr__(self, name: str, value: Any) -> None:
        skill: SkillInterface = self._skill
        parameter = skill.parameter(name)
        if parameter is not None and parameter.is_individual and isinstance(value, api().Element):
            self._given[name] = value
        else:
            super().__setattr__(name, value)
        self.found_out[parameter] = self._given[name]


def taken(parameter: Parameter, params: Any, world: HostedWorld) -> Any:
    """A value from SkiROS2. Raises `ValueError` for a missing required value or a wrong value."""
    value = params.getParamValue(parameter.key)
    if not parameter.is_individual:
        return raised(value, parameter)
    return HostedIndividual(value, world) if value is not None and value.id else None


def give(parameter: Parameter, value: Any, params: Any, world: HostedWorld) -> None:
    """Pass an output of a skill to SkiROS2.

    A changed element is written to the world model, and a new element is added.
    """
    if isinstance(value, HostedIndividual):
        value = world.written(value.element) if value.is_changed else world.element(value.iri)
    elif isinstance(value, WorldIndividual):
        value = world.element(value.iri)
    elif parameter.is_individual and value is not None:
        value = world.written(value)
    elif value is not None:
        value = lowered(value, parameter)
    params.specify(parameter.key, value)


def refresh(parameters: Iterable[Parameter], params: Any, world: HostedWorld) -> None:
    """Give SkiROS2 the changed elements again, because it checks conditions with them."""
    for each in parameters:
        value = params.getParamValue(each.key) if each.is_individual else None
        individual = world.iri(value.id) if value is not None else None
        if individual in world.changed and world.exists(individual):
            params.specify(each.key, world.element(individual))
    world.changed.clear()
