"""The name of a skill in a behavior tree, and its attributes.

`Pick(Object=...)` is a child for any implementation of Pick; `Pick.pick_fast(...)` requires this
implementation. `Pick.SkillBase` is the base class of implementations.
"""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from dataclasses import dataclass
from types import FunctionType
from typing import Any

from dslkit.source import Span
from ezskiros import session
from ezskiros.ontology.symbols import UNKNOWN
from ezskiros.skills import tree_errors as errors
from ezskiros.skills.growing import made


class SkillClass(type):
    """The type of all descriptions."""

    SkillBase: type[Any]
    """The class that the implementations of the skill are derived from."""

    def __call__(cls, *positional: object, **arguments: object) -> Any:
        """A child of a behavior tree."""
        return _child(cls, None, positional, arguments)

    def __getattr__(cls, name: str) -> ImplementationName:
        """The implementation of this name. Whether it exists is known when all files are loaded."""
        if name.startswith("_"):
            raise AttributeError(f"{cls.__name__!r} has no attribute {name!r}")
        return ImplementationName(cls, name)


@dataclass(frozen=True)
class ImplementationName:
    """An implementation that a child of a behavior tree requires."""

    skill: SkillClass
    spelled: str

    def __call__(self, *positional: object, **arguments: object) -> Any:
        """A child of a behavior tree."""
        return _child(self.skill, self.spelled, positional, arguments)

    def __mro_entries__(self, _bases: tuple[object, ...]) -> tuple[type, ...]:
        """The intended base class, if a class is derived from a misspelt `SkillBase`."""
        found = errors.NoSkillBase(skill=self.skill.__name__, spelled=self.spelled)
        session.report(found.at(session.here()))
        return (self.skill.SkillBase,)


@dataclass(frozen=True, eq=False)
class SkillCall:
    """A child that is a skill: `ApproachMovement.go_to_linear(Target=params.GraspPose)`.

    `skill` is its description. `implementation` is the name of the required implementation; None if
    any may run. `arguments` are the given values of the parameters.
    """

    skill: SkillClass
    implementation: str | None
    arguments: Mapping[str, object]
    span: Span


def _child(
    skill: SkillClass,
    implementation: str | None,
    positional: tuple[object, ...],
    arguments: dict[str, object],
) -> Any:
    span = session.here()
    if positional:
        meant = [each for each in _parameters(skill) if each not in arguments][: len(positional)]
        named = ", ".join(f"{each}=..." for each in meant) or "Parameter=value"
        found = errors.NamelessArgument(skill=skill.__name__, named=named)
        session.report(found.at(span))
        arguments |= dict.fromkeys(meant, UNKNOWN)  # the missing value is not reported in addition
    return made(SkillCall(skill, implementation, arguments, span))


def _parameters(skill: SkillClass) -> list[str]:
    """The names of the parameters of a skill, in the order of its description."""
    description = getattr(skill, "description", None)
    if not isinstance(description, FunctionType):
        return []
    return list(inspect.signature(description).parameters)[1:]
