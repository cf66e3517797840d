"""Conversion of command-line texts such as `Object=starter` to values of a skill's parameters."""

from __future__ import annotations

import difflib
import enum
from collections.abc import Iterable
from typing import Any

from ezskiros.engine.values import WorldIndividual, wanted
from ezskiros.engine.world import World
from ezskiros.skills.interface import Parameter, SkillInterface
from ezskiros.skills.markers import ParameterKind

_MOST_NAMED = 10
_TRUTHS = {"true": True, "false": False}


class WrongArgumentError(ValueError):
    """A given value is invalid, or a value is missing. The text lists valid values."""


def read_arguments(skill: SkillInterface, texts: Iterable[str], world: World) -> dict[str, object]:
    """The values of the parameters in texts such as `Name=value`.

    Individuals are given by name, such as `skiros:Product-7`, by label or by IRI, and members of
    enumerations by name. Raises `WrongArgumentError`.
    """
    found: dict[str, object] = {}
    for text in texts:
        name, _, value = text.partition("=")
        parameter = _parameter(skill, name)
        if name in found:
            raise WrongArgumentError(f"`{name}` is given twice")
        read = (
            _individual(parameter, value, world)
            if parameter.is_individual
            else _basic(parameter, value)
        )
        found[name] = read
    for parameter in skill.parameters:
        is_needed = parameter.kind is ParameterKind.REQUIRED and parameter.default is None
        if is_needed and not parameter.is_output and parameter.name not in found:
            would = f"; {_those(parameter, world)}" if parameter.is_individual else ""
            text = f"`{parameter.name}`, {wanted(parameter)}, is not given"
            raise WrongArgumentError(f"{text}: {parameter.name}=...{would}")
    return found


def _parameter(skill: SkillInterface, name: str) -> Parameter:
    parameter = skill.parameter(name)
    names = [each.name for each in skill.parameters if not each.is_output]
    if parameter is None:
        near = difflib.get_close_matches(name, names, n=1)
        has = f"it has {', '.join(names)}" if names else "it has none"
        hint = f"did you mean `{near[0]}`?" if near else has
        raise WrongArgumentError(f"`{skill.name}` has no parameter `{name}`; {hint}")
    if parameter.is_output:
        raise WrongArgumentError(
            f"`{name}` cannot be given, because `{skill.name}` sets this output"
        )
    return parameter


def _individual(parameter: Parameter, name: str, world: World) -> WorldIndividual:
    found = world.named(name)
    fitting = [each for each in found if world.is_a(each, parameter.iri or "")]
    if len(fitting) == 1:
        return WorldIndividual(fitting[0], world)
    if fitting:
        spelled = ", ".join(map(world.spelled, fitting))
        problem = f"several individuals are called {name!r}: {spelled}"
        raise WrongArgumentError(f"`{parameter.name}`: {problem}")
    if found:
        classes = ", ".join(map(world.spelled, world.classes(found[0])))
        problem = (
            f"{world.spelled(found[0])} has the class {classes}, but must be {wanted(parameter)}"
        )
    else:
        problem = f"there is no {name!r} in the world"
    raise WrongArgumentError(f"`{parameter.name}`: {problem}; {_those(parameter, world)}")


def _those(parameter: Parameter, world: World) -> str:
    """Name the individuals of the class of a parameter."""
    individuals = world.individuals(parameter.iri or "")
    if not individuals:
        missing = f"the world has no individual that is {wanted(parameter)}"
        return f"{missing}: add one to the scene (`--scene`)"
    shown = [_with_label(each, world) for each in individuals[:_MOST_NAMED]]
    more = f" and {len(individuals) - _MOST_NAMED} more" if len(individuals) > _MOST_NAMED else ""
    return f"choose from {', '.join(shown)}{more}"


def _with_label(individual: str, world: World) -> str:
    label = world.label(individual)
    return f"{world.spelled(individual)} ({label})" if label else world.spelled(individual)


def _basic(parameter: Parameter, text: str) -> object:
    kind: type[Any] = parameter.type
    try:
        if issubclass(kind, enum.Enum):
            return kind[text]
        return _TRUTHS[text.lower()] if kind is bool else kind(text)
    except (KeyError, ValueError):
        means = " (true or false)" if kind is bool else ""
        problem = f"{text!r} is not {wanted(parameter)}{means}"
        raise WrongArgumentError(f"`{parameter.name}`: {problem}") from None
