"""The facts that a change may end.

Names that may stand for one individual are treated as one individual. A fact that is forgotten
without need only causes a warning; a fact that is kept in error would be unsafe.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ezskiros.check.clash import FactReason
from ezskiros.check.entailed import Fact, Facts, entailed
from ezskiros.check.inference import names as names_of
from ezskiros.check.limits import limit_of_subjects, limits
from ezskiros.contracts.knowledge import Made, Renewed
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
)

MayBeSame = Callable[[str, str], bool]
Classes = Callable[[str], frozenset[str]]


class Touching:
    """The effect of changes, given an ontology. `may_be_same` tests whether two names may stand for
    one individual, and `classes` gives the classes of each name.
    """

    def __init__(self, model: Model, may_be_same: MayBeSame, classes: Classes) -> None:
        self._model, self._may_be_same, self._classes = model, may_be_same, classes
        self._known_closed: dict[Fact, Facts] = {}
        self._known_supports: dict[Fact, tuple[Fact, ...]] = {}

    def touches(self, made: Made, fact: Statement) -> bool:
        """Say whether a change may end a fact."""
        if made == fact:
            return False
        if isinstance(made, (AnyOf, Renewed)) or isinstance(fact, AnyOf):
            return self._touches_in_parts(made, fact)
        match made:
            case OfType():
                return False
            case Specified(subject=subject):
                return subject in names_of(fact) and not made.is_true
            case Generated(subject=subject, is_true=True):
                return fact == Generated(subject, False)
            case Generated(subject=subject):
                return any(self._may_be_same(subject, each) for each in names_of(fact))
            case Relation():
                return isinstance(fact, Relation) and self._relates(made, fact)
            case ValueComparison() | HasProperty():
                return isinstance(fact, (ValueComparison, HasProperty)) and self._sets(made, fact)

    def _touches_in_parts(self, made: Made, fact: Statement) -> bool:
        if isinstance(made, Renewed):
            return made.subject in names_of(fact)
        if isinstance(made, AnyOf):
            return any(self.touches(part, fact) for part in made.parts)
        assert isinstance(fact, AnyOf)
        return any(self.touches(made, part) for part in fact.parts)

    def _sets(
        self, made: ValueComparison | HasProperty, fact: ValueComparison | HasProperty
    ) -> bool:
        """Say whether a changed value ends a fact. This includes facts with a special case or a
        generalization of the property.
        """
        above = self._model.properties_above
        is_related = made.property in above(fact.property) or fact.property in above(made.property)
        return is_related and self._may_be_same(made.subject, fact.subject)

    def _relates(self, made: Relation, fact: Relation) -> bool:
        if made.is_abstract or fact.is_abstract:
            return False
        if not made.is_true and not fact.is_true:
            return False
        supports = self._supports(fact)
        if made.is_true and not fact.is_true:
            denied = supports or (Fact(fact.subject, fact.relation, fact.object),)
            return any(self._meets(new, old) for new in self._following(made) for old in denied)
        held = [old for each in supports for old in self._closed(each)]
        if self._is_chained(fact):
            links = {each.relation for each in held}
            return any(each.relation in links for each in self._breaking(made))
        if made.is_true:
            return any(self._excludes(new, old) for new in self._following(made) for old in held)
        ended = Fact(made.subject, made.relation, made.object)
        return any(self._meets(old, ended) for old in held)

    def _supports(self, said: Relation) -> tuple[Fact, ...]:
        """The relations from which another relation may follow."""
        wanted = Fact(said.subject, said.relation, said.object)
        if wanted not in self._known_supports:
            turned = Fact(said.object, said.relation, said.subject)
            candidates = (
                Fact(ends.subject, iri, ends.object)
                for ends in dict.fromkeys((wanted, turned))
                for iri in self._model.relations
            )
            found = tuple(each for each in candidates if wanted in self._closed(each))
            self._known_supports[wanted] = found
        return self._known_supports[wanted]

    def _breaking(self, made: Relation) -> Iterator[Fact]:
        """The facts that may break a chain, because they end or replace a relation."""
        if not made.is_true:
            yield from self._supports(Relation(made.subject, made.relation, made.object))
        else:
            yield from (each for each in self._following(made) if self._pushes(each))

    def _pushes(self, fact: Fact) -> bool:
        declared = self._model.relations[fact.relation]
        is_counted = self._is_limited(fact.subject, fact.relation) or bool(
            limit_of_subjects(fact.relation, self._model)
        )
        return is_counted or declared.is_asymmetric or declared.is_irreflexive

    def _is_chained(self, said: Relation) -> bool:
        """Say whether a relation may follow from several others."""
        return any(
            self._model.relations[each.relation].is_transitive for each in self._supports(said)
        )

    def _following(self, said: Relation) -> Iterator[Fact]:
        """A relation that holds, and its consequences."""
        yield from self._closed(Fact(said.subject, said.relation, said.object))

    def _closed(self, fact: Fact) -> Facts:
        if fact not in self._known_closed:
            self._known_closed[fact] = entailed([Relation(*fact)], self._model)
        return self._known_closed[fact]

    def _meets(self, fact: Fact, denied: Fact) -> bool:
        """Say whether a relation may be the denied one, or a step of a chain to it."""
        if fact.relation != denied.relation:
            return False
        declared = self._model.relations.get(fact.relation)
        if declared is not None and declared.is_transitive:
            return True
        same = self._may_be_same
        return same(fact.subject, denied.subject) and same(fact.object, denied.object)

    def _excludes(self, new: Fact, old: Fact) -> bool:
        """Say whether another relation may replace a relation."""
        if new == old or new.relation != old.relation:
            return False
        same, iri = self._may_be_same, new.relation
        if self._is_limited(new.subject, iri) and same(new.subject, old.subject):
            return True
        if limit_of_subjects(iri, self._model) and same(new.object, old.object):
            return True
        declared = self._model.relations[iri]
        is_one_way = declared.is_asymmetric
        return is_one_way and same(new.subject, old.object) and same(new.object, old.subject)

    def _is_limited(self, name: str, iri: str) -> bool:
        classes = dict.fromkeys(self._classes(name), FactReason())
        return next(limits(iri, classes, self._model), None) is not None
