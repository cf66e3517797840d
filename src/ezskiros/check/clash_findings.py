"""The findings of clashes: their texts and labels."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from dslkit.diagnostics import Diagnostic, Template, listed
from ezskiros.check import world_errors
from ezskiros.check.clash import Clash
from ezskiros.check.spelled import spelled, spelled_iri
from ezskiros.check.world_errors import IriHere
from ezskiros.check.worlds import certain
from ezskiros.ontology import Ontology
from ezskiros.ontology.statements import Statement
from ezskiros.skills.interface import Clause, SkillInterface

Places: TypeAlias = Mapping[Statement, Clause]
"""The statements that certainly hold, in order, and the conditions that imply them."""


def places_of(clauses: Iterable[Clause]) -> Places:
    """Collect the statements that some conditions imply together."""
    found: dict[Statement, Clause] = {}
    for clause in clauses:
        for each in certain([clause.statement]):
            found.setdefault(each, clause)
    return found


@dataclass(frozen=True)
class ClashMoment:
    """The time at which conditions hold together, and the consequence if they cannot."""

    kind: str
    when: str
    consequence: str


class ClashFindings:
    """The findings about one skill."""

    def __init__(self, skill: SkillInterface, ontology: Ontology) -> None:
        self._skill, self._ontology, self._model = skill, ontology, ontology.model

    def listed(self, said: Iterable[Statement]) -> str:
        """Statements as users wrote them."""
        return listed([spelled(each, self._model) for each in said])

    def found(self, clash: Clash, moment: ClashMoment, places: Places) -> Diagnostic:
        """Report that conditions cannot hold together at a moment."""
        found = clash.kind(
            together=self.listed(_in_order(clash, places)),
            when=moment.when,
            why=clash.reason(self._model),
            kind=moment.kind,
            consequence=moment.consequence,
        )
        return self._at(found, clash, places)

    def ended(self, clash: Clash, places: Places) -> Diagnostic:
        """Report that post-conditions end a hold-condition."""
        why = clash.reason(self._model)
        found = world_errors.EndsItsHold(
            together=self.listed(_in_order(clash, places)),
            skill=self._skill.name,
            why=f"{why}. " if why else "",
        )
        return self._at(found, clash, places)

    def _at(self, found: Template, clash: Clash, places: Places) -> Diagnostic:
        """The finding at the last of the conditions, with the other conditions and the declarations
        of the ontology.
        """
        *others, last = (places[each].span for each in _in_order(clash, places))
        is_of_individual = clash.kind is world_errors.ImpossibleIndividual
        other = world_errors.OfOneIndividual() if is_of_individual else world_errors.AtOneTime()
        labels = [other.at(span) for span in others if span != last]
        individual = self._skill.parameter(clash.individual) if clash.individual else None
        if individual is not None and individual.iri:
            declared = world_errors.DeclaredAs(owl_class=spelled_iri(individual.iri, self._model))
            labels.append(declared.at(individual.span))
        for iri in clash.declared():
            label = self._ontology.label(iri, IriHere(iri=spelled_iri(iri, self._model)))
            labels += [label] if label else []
        return found.at(last, *labels)


def _in_order(clash: Clash, places: Places) -> list[Statement]:
    """The statements in source order."""
    return [each for each in places if each in clash.said]
