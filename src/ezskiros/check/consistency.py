"""Checks of conditions against each other: repeated conditions, and conditions that no world model
satisfies together.

Pre- and hold-conditions hold when a skill starts; post-conditions hold after it. A post-condition
ends earlier facts that it excludes; this is only reported if it ends a hold-condition. The classes
of individuals never change.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeAlias

from dslkit.diagnostics import DeclaredHere, Diagnostic, Label, Severity
from ezskiros.check import errors, world_errors
from ezskiros.check.clash import Clash, FactReason
from ezskiros.check.clash_findings import ClashFindings, ClashMoment, Places, places_of
from ezskiros.check.entailed import Fact
from ezskiros.check.individual_classes import class_clashes
from ezskiros.check.relations import misfit, simple, wanted
from ezskiros.check.spelled import spelled_iri
from ezskiros.check.worlds import Literals, PossibleWorld, alternatives, known_classes
from ezskiros.ontology import Ontology
from ezskiros.ontology.model import Union
from ezskiros.ontology.statements import Relation, Statement
from ezskiros.skills.interface import Clause, SkillInterface

Said: TypeAlias = frozenset[Statement]
MOST_ALTERNATIVES = 64
"""The most combinations of the alternatives of several `or`. Further combinations are not examined.
"""


def check_consistency(skill: SkillInterface, ontology: Ontology) -> Iterator[Diagnostic]:
    """Report contradictions and repetitions among the conditions."""
    for kind, clauses in (("pre", skill.pre), ("hold", skill.hold), ("post", skill.post)):
        seen: dict[Statement, Clause] = {}
        for clause in clauses:
            first = seen.setdefault(clause.statement, clause)
            if first is not clause:
                repeated = errors.Repeated(kind=kind)
                yield repeated.at(clause.span, repeated.First().at(first.span))
    yield from _Consistency(skill, ontology).check()


class _Consistency:
    """The conditions of one skill."""

    def __init__(self, skill: SkillInterface, ontology: Ontology) -> None:
        self._skill, self._ontology, self._model = skill, ontology, ontology.model
        self._declared = {
            each.name: {each.iri: FactReason()} for each in skill.parameters if each.iri
        }
        self._findings = ClashFindings(skill, ontology)
        self._facts: dict[Fact, FactReason] = {}
        """The facts that hold at any time: the classes of individuals never change."""
        name = skill.name
        self._before = ClashMoment("pre", f"before `{name}`", "the skill can never start")
        self._during = ClashMoment(
            "hold", f"while `{name}` runs", "the skill fails as soon as it starts"
        )
        self._after = ClashMoment("post", f"after `{name}`", "the skill can never succeed")

    def check(self) -> Iterator[Diagnostic]:
        skill = self._skill
        start = (*skill.pre, *skill.hold)
        before: list[Said] = []
        after: list[Said] = []
        yield from self._checked(self._before, skill.pre, before)
        if skill.hold:
            yield from self._checked(self._during, start, before)
        yield from self._checked(self._after, skill.post, after)
        yield from self._empty_classes()
        yield from self._classes(places_of([*start, *skill.post]))
        if skill.hold:
            yield from self._ended((*skill.hold, *skill.post), [*before, *after])

    def _checked(
        self, moment: ClashMoment, clauses: Sequence[Clause], reported: list[Said]
    ) -> Iterator[Diagnostic]:
        places = places_of(clauses)
        world = self._world(places)
        for fact, reason in world.facts.items():
            self._facts.setdefault(fact, reason)
        for clash in _new(world.clashes(), reported):
            yield self._findings.found(clash, moment, places)
        ors = [each for each in clauses if len(alternatives(each.statement)) > 1]
        if ors and not self._is_impossible(world):
            yield from self._alternatives(moment, ors, places, reported)

    def _world(self, said: Iterable[Statement]) -> PossibleWorld:
        return PossibleWorld(self._declared, self._model, said)

    # --- classes, which never change --------------------------------------------------------------

    def _empty_classes(self) -> Iterator[Diagnostic]:
        for parameter in self._skill.parameters if self._model.has_disjoint_classes else ():
            if parameter.iri and self._model.is_empty(parameter.iri):
                conflict = self._model.conflict(parameter.iri)
                both = " and ".join(
                    f"a {spelled_iri(each, self._model)}" for each in conflict or ()
                )
                why = f"{both}, which are disjoint" if conflict else "below owl:Nothing"
                owl_class = spelled_iri(parameter.iri, self._model)
                found = world_errors.EmptyClass(owl_class=owl_class, why=why)
                label = self._ontology.label(parameter.iri, DeclaredHere())
                yield found.at(parameter.span, *filter(None, [label]))

    def _classes(self, places: Places) -> Iterator[Diagnostic]:
        classes = known_classes(self._declared, places)
        clashes = class_clashes(self._facts, classes, self._model, self._is_misfit)
        for clash in _new(clashes, []):
            yield self._findings.found(clash, self._before, places)

    def _is_misfit(self, name: str, union: Union) -> bool:
        """Say whether a relation needs this class and the parameter does not fit, which
        `check_relations` reports.
        """
        skill, model = self._skill, self._model
        if misfit(model, skill.class_of(name), union) is not errors.DoesNotFit:
            return False
        clauses = (*skill.pre, *skill.hold, *skill.post)
        said = (each for clause in clauses for each in simple(clause.statement))
        return any(
            (each.subject == name and union in model.domain(each.relation))
            or (each.object == name and union in wanted(skill, model, each.subject, each.relation))
            for each in said
            if isinstance(each, Relation)
        )

    # --- alternatives -----------------------------------------------------------------------------

    def _alternatives(
        self,
        moment: ClashMoment,
        ors: Sequence[Clause],
        places: Places,
        reported: list[Said],
    ) -> Iterator[Diagnostic]:
        """Each `or` without any remaining alternative, given the certain facts and the remaining
        alternatives of the others.
        """
        remaining: list[Literals] = [()]
        others: list[Clause] = []
        for clause in ors:
            parts = alternatives(clause.statement)
            if len(parts) * len(remaining) > MOST_ALTERNATIVES:
                continue
            further = [(*alternative, *part) for alternative in remaining for part in parts]
            left = [
                each for each in further if not self._is_impossible(self._world([*places, *each]))
            ]
            if left:
                remaining = left
                others.append(clause)
            elif frozenset({clause.statement}) not in reported:
                reported.append(frozenset({clause.statement}))
                yield self._none_left(clause, moment, places, others)

    def _is_impossible(self, world: PossibleWorld) -> bool:
        return next(self._impossible(world), None) is not None

    def _impossible(self, world: PossibleWorld) -> Iterator[Clash]:
        """Find the reasons why no world model satisfies the conditions."""
        yield from filter(_is_error, world.clashes())
        yield from class_clashes(world.facts, world.classes, self._model)

    def _none_left(
        self,
        clause: Clause,
        moment: ClashMoment,
        places: Places,
        others: Sequence[Clause],
    ) -> Diagnostic:
        found = world_errors.NoAlternative(kind=moment.kind, when=moment.when)
        labels: dict[Label, None] = {}
        whys: dict[str, None] = {}
        for part in alternatives(clause.statement):
            world = self._world([*places, *part])
            clash = next(self._impossible(world), None)
            if clash is None:
                labels |= {found.Together().at(each.span): None for each in others}
                continue
            excludes = found.Excludes(part=self._findings.listed(part))
            labels |= {
                excludes.at(places[each].span): None for each in places if each in clash.said
            }
            whys[clash.reason(self._model)] = None
        return found.at(clause.span, *labels, notes=[found.Why(why=why) for why in whys if why])

    # --- the end of hold-conditions ---------------------------------------------------------------

    def _ended(self, clauses: Sequence[Clause], reported: list[Said]) -> Iterator[Diagnostic]:
        places = places_of(clauses)
        clashes = (each for each in self._world(places).clashes() if _is_error(each))
        for clash in _new(clashes, reported):
            yield self._findings.ended(clash, places)


def _new(clashes: Iterable[Clash], reported: list[Said]) -> Iterator[Clash]:
    """The clashes of which no part has been reported."""
    for clash in clashes:
        if not any(each <= clash.said for each in reported):
            reported.append(clash.said)
            yield clash


def _is_error(clash: Clash) -> bool:
    return clash.kind.severity is Severity.ERROR
