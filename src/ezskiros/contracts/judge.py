"""The judge: consequences of the known conditions, and statements that contradict them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache
from itertools import chain, combinations, islice, product
from typing import TypeAlias

from dslkit.diagnostics import Severity
from ezskiros.check import errors
from ezskiros.check.clash import Clash, FactReason
from ezskiros.check.entailed import fact_of
from ezskiros.check.individual_classes import class_clashes
from ezskiros.check.inference import names as names_of
from ezskiros.check.worlds import PossibleWorld, alternatives
from ezskiros.contracts.knowledge import (
    KnownFacts,
    Made,
    NameKnowledge,
    Origin,
    Renewed,
    WorldChange,
)
from ezskiros.contracts.statements import renamed
from ezskiros.contracts.touching import Touching
from ezskiros.ontology.model import Model
from ezskiros.ontology.statements import (
    AnyOf,
    Generated,
    HasProperty,
    OfType,
    Relation,
    Specified,
    Statement,
    ValueComparison,
    negated,
)

Said: TypeAlias = tuple[Statement, ...]
"""Facts in order. The order decides which of several reasons is reported."""

_ANYTHING = NameKnowledge(frozenset(), is_own=False)
MOST_CHOICES = 1000
"""The most individuals that are tried for inferred parameters."""


class Judge:
    """The judge for the names of one tree.

    The judge keeps its results, because a tree is walked again for each tick, mostly with the same
    queries about the same facts.
    """

    def __init__(self, model: Model, names: Mapping[str, NameKnowledge]) -> None:
        self.model, self._names = model, names
        self._declared = {
            name: {iri: FactReason() for iri in known.classes} if len(known.classes) == 1 else {}
            for name, known in names.items()
        }
        touching = Touching(model, self.may_be_same, lambda name: self._known(name).classes)
        self._touches = cache(touching.touches)
        self._clashes = cache(self._found_clashes)
        self._clash = cache(self._found_clash)
        self._entails = cache(self._found_entailed)
        self._ended = cache(self._found_ended)
        self._world = cache(self._made_world)

    def may_be_same(self, one: str, other: str) -> bool:
        """Say whether two names may stand for one individual. They cannot if both are parameters of
        the compound, or if their classes have no individual in common.
        """
        if one == other:
            return True
        here, there = self._known(one), self._known(other)
        if here.is_own and there.is_own:
            return False
        return not here.classes or not there.classes or any(
            not self.model.are_disjoint(iri, another)
            for iri in here.classes
            for another in there.classes
        )  # fmt: skip

    def _known(self, name: str) -> NameKnowledge:
        return self._names.get(name, _ANYTHING)

    # --- consequences -----------------------------------------------------------------------------

    def entails(self, known: KnownFacts, said: Statement) -> bool:
        """Say whether a statement certainly holds."""
        if said in known.facts:
            return True
        ors = tuple(each for each in known.said if isinstance(each, AnyOf))
        return self._entails(known.said, ors, known.bound.intersection(names_of(said)), said)

    def _found_entailed(
        self, facts: Said, ors: tuple[AnyOf, ...], bound: frozenset[str], said: Statement
    ) -> bool:
        """Say whether a statement follows. `ors` are the facts whose alternatives are examined."""
        if said in facts:
            return True
        match said:
            case Specified(subject=subject):
                return said.is_true and subject in bound
            case Generated(subject=subject):
                return said.is_true and subject in bound and Generated(subject, False) not in facts
            case OfType(subject=subject, owl_class=wanted):
                classes = self._world(facts).classes.get(subject, {})
                return any(self.model.is_a(each, wanted) for each in classes)
            case Relation(is_abstract=True):
                return False
            case AnyOf():
                found = alternatives(said)
                if any(
                    all(self._entails(facts, ors, bound, each) for each in alternative)
                    for alternative in found
                ):
                    return True
            case Relation() | ValueComparison() | HasProperty():
                if self._follows(facts, said):
                    return True
        return self._follows_from_each(facts, ors, bound, said)

    def _follows(self, facts: Said, said: Statement) -> bool:
        """Say whether a statement follows by the ontology, directly or because its negation is
        impossible.
        """
        if (
            isinstance(said, Relation)
            and said.is_true
            and fact_of(said) in self._world(facts).facts
        ):
            return True
        opposite = negated(said)
        return opposite is not None and self._clash(facts, opposite) is not None

    def _follows_from_each(
        self, facts: Said, ors: tuple[AnyOf, ...], bound: frozenset[str], said: Statement
    ) -> bool:
        """Say whether a statement follows from each alternative of a known `or`. Only later `or`
        facts are examined inside an alternative, so that each combination is examined once.
        """
        for index, one in enumerate(ors):
            rest = [each for each in facts if each != one]
            found = (
                tuple(dict.fromkeys([*alternative, *rest])) for alternative in alternatives(one)
            )
            if all(
                self._entails(alternative, ors[index + 1 :], bound, said) for alternative in found
            ):
                return True
        return False

    # --- contradictions ---------------------------------------------------------------------------

    def clash(self, known: KnownFacts, said: Statement) -> Clash | None:
        """The reason why a statement cannot hold, for any assignment of names to individuals; None
        if it can hold.
        """
        return self._clash(known.said, said)

    def _found_clash(self, facts: Said, said: Statement) -> Clash | None:
        if isinstance(said, AnyOf):
            found = [self._clash_of_all(facts, alternative) for alternative in alternatives(said)]
            return found[0] if found and all(found) else None
        own = (each for each in facts if all(self._known(n).is_own for n in names_of(each)))
        for each in chain(self._clashes((*facts, said)), self._clashes((*own, said))):
            if said in each.said and self._is_certain(each):
                return each
        return None

    def _clash_of_all(self, facts: Said, alternative: Iterable[Statement]) -> Clash | None:
        found = (self._clash(facts, each) for each in alternative)
        return next(filter(None, found), None)

    def is_impossible(self, said: Iterable[Statement]) -> bool:
        """Say whether statements cannot hold together."""
        return bool(self._clashes(tuple(said)))

    def _found_clashes(self, said: Said) -> tuple[Clash, ...]:
        world = self._world(said)
        found = chain(world.clashes(), class_clashes(world.facts, world.classes, self.model))
        return tuple(each for each in found if each.kind.severity is Severity.ERROR)

    def _made_world(self, said: Said) -> PossibleWorld:
        return PossibleWorld(self._declared, self.model, said)

    def _is_certain(self, clash: Clash) -> bool:
        """Say whether a clash remains if two names stand for one individual."""
        return not any(True for _ in self._resolving_pairs(clash))

    def _resolving_pairs(self, clash: Clash) -> Iterator[tuple[str, str]]:
        """Pairs of names that would resolve the clash if they stood for one individual."""
        about = dict.fromkeys(name for each in clash.said for name in names_of(each))
        for one, other in combinations(sorted(about), 2):
            if self.may_be_same(one, other):
                merged = [renamed(each, {one: other}) for each in clash.said]
                if not self.is_impossible(merged):
                    yield one, other

    # --- ended facts ------------------------------------------------------------------------------

    def touches(self, made: Made, fact: Statement) -> bool:
        """Say whether a change may end a fact."""
        return self._touches(made, fact)

    def ended(self, known: KnownFacts, changes: Iterable[WorldChange]) -> frozenset[Statement]:
        """The facts that changes may end, alone or together with known facts."""
        return self._ended(known.said, tuple(each.made for each in changes))

    def _found_ended(self, facts: Said, made: tuple[Made, ...]) -> frozenset[Statement]:
        new = tuple(each for each in made if not isinstance(each, Renewed))
        clashes = (each.said for each in self._clashes((*facts, *new)))
        excluded = frozenset().union(*(said for said in clashes if not said.isdisjoint(new)))
        touched = (fact for fact in facts if any(self._touches(each, fact) for each in made))
        return excluded.intersection(facts).union(touched)

    # --- names ------------------------------------------------------------------------------------

    def merged(self, known: KnownFacts) -> KnownFacts:
        """The knowledge with merged names, if they must stand for one individual, for example by
        functional relations.
        """
        for clash in self._clashes(known.said):
            if clash.kind is errors.TwoPlaces and len(clash.said) == 2:
                found = list(self._resolving_pairs(clash))
                if len(found) == 1:
                    return self.merged(self._as_one(known, *found[0]))
        return known

    def _as_one(self, known: KnownFacts, one: str, other: str) -> KnownFacts:
        gone, kept = (other, one) if self._known(one).is_own else (one, other)
        facts: dict[Statement, Origin] = {}
        for each, origin in known.facts.items():
            facts.setdefault(renamed(each, {gone: kept}), origin)
        same = {name: kept if to == gone else to for name, to in known.same.items()}
        return replace(known, facts=facts, same={**same, gone: kept})

    def choice(
        self, known: KnownFacts, asked: Sequence[Statement], free: Iterable[str]
    ) -> Mapping[str, str]:
        """Known individuals for the inferred parameters that satisfy most conditions."""
        free = list(free)
        options = [[*self._candidates(known, asked, name), name] for name in free]
        best, most = dict[str, str](), 0
        for chosen in islice(product(*options), MOST_CHOICES):
            names = dict(zip(free, chosen, strict=True))
            count = sum(self.entails(known, renamed(each, names)) for each in asked)
            if count > most:
                best, most = names, count
            if most == len(asked):
                break
        return best

    def _candidates(
        self, known: KnownFacts, asked: Sequence[Statement], free: str
    ) -> Iterator[str]:
        """Names that fit a parameter and satisfy its conditions, as far as this is known before the
        other parameters are chosen.
        """
        facts = self._world(known.said).facts
        related: list[set[str]] = []
        for each in asked:
            if isinstance(each, Relation) and each.is_true and not each.is_abstract:
                there = [fact for fact in facts if fact.relation == each.relation]
                related += [{fact.subject for fact in there}] if each.subject == free else []
                related += [{fact.object for fact in there}] if each.object == free else []
        for name in sorted(known.bound):
            is_related = not related or any(name in each for each in related)
            if name not in known.same and is_related and self._fits(name, free):
                yield name

    def _fits(self, name: str, free: str) -> bool:
        """Say whether the individual of one name has the class of the other name."""
        here, there = self._known(name).classes, self._known(free).classes
        return all(any(self.model.is_a(iri, wanted) for wanted in there) for iri in here)
