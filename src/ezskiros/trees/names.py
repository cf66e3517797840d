"""The names that the parameters of a child share with the compound skill and with its other
children.

As in SkiROS2, a running tree has one set of names. A child parameter that is set to a compound
parameter shares the name of that parameter. A child parameter without an argument shares its own
name, unless it has a default: then only an output of the skill uses the name.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ezskiros.skills.calls import SkillCall
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.skills.interface import Parameter, SkillInterface
from ezskiros.skills.markers import ParameterKind
from ezskiros.skills.syntax import set_in
from ezskiros.trees.library import Library
from ezskiros.trees.tree import IndividualReference, ValueReference


@dataclass(frozen=True)
class Shared:
    """A parameter of a child that shares a name."""

    parameter: Parameter
    shared: str
    is_passed: bool
    """True if the child gets the parameter as an argument; False if the names are equal."""


def shared_names(call: SkillCall, skill: SkillInterface) -> Iterator[Shared]:
    """The shared names of the parameters of a child that have no value of their own."""
    for parameter in skill.parameters:
        if parameter.name not in call.arguments:
            if parameter.is_individual or parameter.default is None:
                yield Shared(parameter, parameter.name, False)
            continue
        given = call.arguments[parameter.name]
        if isinstance(given, (IndividualReference, ValueReference)):
            yield Shared(parameter, given.parameter.name, True)


def found_out(
    call: SkillCall, skill: SkillInterface, implementations: Iterable[type[SkillImplementation]]
) -> list[Shared]:
    """The parameters with a default at the start of the child that an implementation sets. After a
    success, their names have the new values.
    """
    own = [
        each
        for each in skill.parameters
        if each.kind is ParameterKind.OPTIONAL
        and each.default is not None
        and each.name not in call.arguments
    ]
    names = {name for each in implementations for name in set_in(each)} if own else set()
    return [Shared(each, each.name, False) for each in own if each.name in names]


def all_shared(call: SkillCall, library: Library) -> list[Shared]:
    """All shared names of a child, for any implementation; none for an unknown skill."""
    skill = library.skill(call.skill)
    if skill is None:
        return []
    doing = library.doing(call)
    return [*shared_names(call, skill), *found_out(call, skill, doing)]
