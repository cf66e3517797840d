"""All known skills and their implementations."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from typing import TypeVar

from dslkit.diagnostics import Diagnostic
from ezskiros import session
from ezskiros.ontology import Ontology
from ezskiros.skills.calls import SkillCall, SkillClass
from ezskiros.skills.describe import DescribedSkill, describe
from ezskiros.skills.description import SkillDescription
from ezskiros.skills.implementation import SkillImplementation
from ezskiros.skills.interface import SkillInterface
from ezskiros.skills.own_conditions import refined

T = TypeVar("T")
Implementations = Mapping[str, type[SkillImplementation]]
LaunchValues = Mapping[str, Mapping[str, object]]
"""Parameter values that are known at launch, by skill name and parameter name."""


class Library:
    """Skills by description, with their implementations.

    `described` are the checked skills. Trees may name other skills, of libraries. Those are read on
    demand; mistakes in them are reported when those libraries are checked.
    """

    def __init__(self, described: Mapping[SkillClass, DescribedSkill]) -> None:
        self.checked = tuple(described)
        """The checked skills, in source order."""
        self._described: dict[SkillClass, DescribedSkill | None] = {**described}
        self._refined: dict[type[SkillImplementation], DescribedSkill | None] = {}
        self.elsewhere: list[Diagnostic] = []
        """Findings in other skills, as far as these were read."""

    def descriptions(self) -> list[SkillClass]:
        """All known descriptions, in the order in which they were loaded."""
        return [each for each in self._described if issubclass(each, SkillDescription)]

    def skill(self, description: SkillClass) -> SkillInterface | None:
        """The interface of a skill; None if its description has no content."""
        found = self._known(description)
        return found.interface if found else None

    def refine(self, implementation: type[SkillImplementation]) -> SkillInterface | None:
        """The interface of a skill with one implementation's own pre-conditions. Their mistakes are
        reported.
        """
        if implementation not in self._refined:
            described = self._known(implementation.description)
            found = refined(implementation, described) if described else None
            self._refined[implementation] = found
        known = self._refined[implementation]
        return known.interface if known else None

    def as_done_by(self, implementation: type[SkillImplementation]) -> SkillInterface | None:
        """The same interface as `refine`. New mistakes count as those of another library."""
        if implementation in self._refined:
            return self.refine(implementation)
        with session.trying() as found:
            interface = self.refine(implementation)
        self.elsewhere += found.sorted()
        return interface

    def called(self, call: SkillCall) -> SkillInterface | None:
        """The interface of a child, with the pre-conditions of its implementation if only one is
        possible.
        """
        doing = self.doing(call)
        return self.as_done_by(doing[0]) if len(doing) == 1 else self.skill(call.skill)

    def skills(self) -> list[SkillInterface]:
        """All known skills."""
        return [each.interface for each in self._described.values() if each]

    def is_whole(self, skill: SkillInterface) -> bool:
        """Say whether all conditions of a skill were understood."""
        known = (*self._described.values(), *self._refined.values())
        return all(each.is_whole for each in known if each and each.interface is skill)

    def ontology(self) -> Ontology | None:
        """The ontology of the types of the skills; None if no skill has individuals."""
        found = (each.ontology for each in self._described.values() if each)
        return next(filter(None, found), None)

    def implementations(self, description: SkillClass) -> Implementations:
        """The implementations of a skill, by name, in the order in which they were loaded."""
        return implementations(description)

    def doing(self, call: SkillCall) -> list[type[SkillImplementation]]:
        """The possible implementations of a child of a tree."""
        known = self.implementations(call.skill).values()
        return [each for each in known if call.implementation in (None, each.__name__)]

    def owner(self, implementation: str) -> SkillInterface | None:
        """The skill that an implementation with this name implements."""
        for description in list(self._described):
            if implementation in self.implementations(description):
                return self.skill(description)
        return None

    def _known(self, description: SkillClass) -> DescribedSkill | None:
        if description not in self._described:
            with session.trying() as found:
                self._described[description] = describe(description)
            self.elsewhere += found.sorted()
        return self._described[description]


def implementations(description: SkillClass) -> Implementations:
    """The implementations of a skill, by name, of all modules that have been imported."""
    return {each.__name__: each for each in _derived(description.SkillBase)}


def known_skills() -> Iterator[SkillClass]:
    """All skills of all modules that have been imported."""
    return _derived(SkillDescription)


def _derived(base: type[T]) -> Iterator[type[T]]:
    """The classes derived from a class that have no derived classes themselves. Classes of modules
    that were imported again are left out.
    """
    for each in type.__subclasses__(base):
        module = sys.modules.get(each.__module__)
        if vars(module or object).get(each.__name__) is each:
            below = list(_derived(each))
            yield from below or [each]
