"""The effect of `CONSUME`, `UNSPECIFY`, `LOCK` and `RESPECT_TYPE` on a running skill."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, Protocol

from ezskiros.engine.events import Code, Reason
from ezskiros.ontology.statements import Generated, OfType
from ezskiros.skills.interface import Clause, Parameter, SkillInterface
from ezskiros.skills.markers import Option


def with_options(skill: SkillInterface) -> SkillInterface:
    """A skill with the conditions that its options imply.

    A consumed individual does not exist after the skill. The class of an individual with
    `RESPECT_TYPE` needs no condition here, because all candidates have the class.
    """
    pre = [
        Clause(OfType(each.name, each.iri or ""), each.span)
        for each in _with(skill, Option.RESPECT_TYPE)
    ]
    post = [
        Clause(Generated(each.name, is_true=False), each.span)
        for each in _with(skill, Option.CONSUME)
    ]
    if not pre and not post:
        return skill
    return replace(skill, pre=(*skill.pre, *pre), post=(*skill.post, *post))


def emptied(skill: SkillInterface) -> tuple[str, ...]:
    """The parameters without a value after the skill."""
    lost = (Option.CONSUME, Option.UNSPECIFY)
    return tuple(each.name for option in lost for each in _with(skill, option))


def locked(skill: SkillInterface) -> tuple[str, ...]:
    """The parameters whose individuals no other skill may lock at the same time."""
    return tuple(each.name for each in _with(skill, Option.LOCK))


def _with(skill: SkillInterface, option: Option) -> Iterator[Parameter]:
    return (each for each in skill.parameters if each.is_individual and option in each.options)


class Owner(Protocol):
    """A running skill as the owner of locks: its parents, and its name in the tree."""

    @property
    def above(self) -> Owner | None:
        """The parent compound; None at the root."""

    @property
    def path(self) -> tuple[str, ...]:
        """The names of the skills from the root."""


class Locks:
    """The locks of skills on individuals. Skills below an owner may lock the same individual, one
    at a time.
    """

    def __init__(self) -> None:
        self._owners: dict[str, list[Owner]] = {}

    def lock(
        self, skill: Owner, names: tuple[str, ...], values: Mapping[str, Any]
    ) -> Reason | None:
        """Lock the individuals of some parameters. Returns None on success, otherwise the
        reason.
        """
        individuals = {name: values[name] for name in names if values[name] is not None}
        for name, individual in individuals.items():
            owners = self._owners.get(individual.iri)
            if owners and not _is_above(owners[-1], skill):
                path = "/".join(owners[-1].path)
                return Reason(Code.PRE, f"`{name}`, {individual}, is locked by {path}")
        for individual in individuals.values():
            self._owners.setdefault(individual.iri, []).append(skill)
        return None

    def release(self, skill: Owner) -> None:
        """Release the locks of a skill."""
        for owners in self._owners.values():
            owners[:] = [each for each in owners if each is not skill]


def _is_above(owner: Owner, skill: Owner | None) -> bool:
    while skill is not None and skill is not owner:
        skill = skill.above
    return skill is owner
