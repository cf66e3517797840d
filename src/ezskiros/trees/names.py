"""Which names the parameters of a child share with the compound and with its other children.

As in SkiROS2 a running tree has one set of names. A parameter of a child that is passed one of the
compound shares the name of that; one that is given nothing shares its own name.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ezskiros.skills.interface import Parameter, SkillInterface
from ezskiros.skills.nodes import SkillCall
from ezskiros.trees.tree import ThingReference, ValueReference


@dataclass(frozen=True)
class Shared:
    """A parameter of a child that shares a name."""

    parameter: Parameter
    shared: str
    is_passed: bool
    """Whether the child says so; else the names are the same."""


def shared_names(call: SkillCall, skill: SkillInterface) -> Iterator[Shared]:
    """For each parameter of the child that has no value of its own."""
    for parameter in skill.parameters:
        if parameter.name not in call.arguments:
            if parameter.is_thing or parameter.default is None:
                yield Shared(parameter, parameter.name, False)
            continue
        given = call.arguments[parameter.name]
        if isinstance(given, (ThingReference, ValueReference)):
            yield Shared(parameter, given.parameter.name, True)
