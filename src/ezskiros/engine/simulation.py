"""The simulation of a primitive: its post-conditions become true, and its outputs get invented
values.
"""

from __future__ import annotations

import enum
from typing import Any

from ezskiros.engine.conditions import make
from ezskiros.engine.grounding import bound
from ezskiros.engine.plans import ChildStart
from ezskiros.engine.values import WorldIndividual
from ezskiros.engine.world import World
from ezskiros.skills.interface import Parameter


def simulate(plan: ChildStart, values: dict[str, Any], world: World) -> None:
    """Apply the effects of a skill to `values` and to the world.

    An output gets a new individual of its class, or false, 0, an empty text or the first member of
    its enumeration.
    """
    for parameter in plan.skill.parameters:
        if parameter.is_output and values[parameter.name] is None:
            values[parameter.name] = _made_up(parameter, world)
    individuals = bound(values)
    for clause in plan.skill.post:
        make(clause.statement, individuals, world)


def _made_up(parameter: Parameter, world: World) -> object:
    if parameter.iri is not None:
        return WorldIndividual(world.new(parameter.iri), world)
    if issubclass(parameter.type, enum.Enum):
        return next(iter(parameter.type))
    return parameter.type()
