"""Relations that follow from others by the ontology, and relations that cannot hold together.

The module handles subproperties, inverses, symmetry and transitivity, and relations that are
functional, inverse functional, asymmetric, irreflexive, or limited in number by a class. Each
parameter is assumed to stand for a different individual; this matters only for the limits in
number.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple, TypeAlias

from ezskiros.check import errors, world_errors
from ezskiros.check.clash import Axiom, Clash, FactReason, KnownClasses, joined
from ezskiros.check.limits import limit_of_subjects, limits
from ezskiros.check.spelled import spelled
from ezskiros.ontology.model import Model
from ezskiros.ontology.statements import Relation


class Fact(NamedTuple):
    """A relation that holds."""

    subject: str
    relation: str
    object: str


Facts: TypeAlias = Mapping[Fact, FactReason]
"""Relations that hold, each with a reason."""


def fact_of(said: Relation) -> Fact:
    """The relation in a statement."""
    return Fact(said.subject, said.relation, said.object)


def entailed(stated: Iterable[Relation], model: Model) -> Facts:
    """Some relations, and all relations that follow from them."""
    found = {fact_of(each): FactReason(frozenset({each})) for each in stated}
    work = list(found)
    for fact in work:
        for other, sources, axiom in _following(fact, found, model):
            if other not in found:
                found[other] = joined(*(found[each] for each in sources), axiom=axiom)
                work.append(other)
    return found


def _following(
    fact: Fact, found: Iterable[Fact], model: Model
) -> Iterator[tuple[Fact, tuple[Fact, ...], Axiom]]:
    """Yield the consequences of one step, with the facts and the axiom behind each."""
    declared = model.relations.get(fact.relation)
    if declared is None:
        return
    for iri in sorted(declared.parents):
        axiom = Axiom("{} is a special case of {}", (declared.iri, iri))
        yield Fact(fact.subject, iri, fact.object), (fact,), axiom
    for iri in sorted(declared.inverses):
        axiom = Axiom("{} is the inverse of {}", (declared.iri, iri))
        axiom = Axiom("{} is symmetric", (iri,)) if iri == declared.iri else axiom
        yield Fact(fact.object, iri, fact.subject), (fact,), axiom
    if declared.is_transitive:
        axiom = Axiom("{} is transitive", (declared.iri,))
        for other in list(found):
            for first, second in ((fact, other), (other, fact)):
                if first.relation == second.relation and first.object == second.subject:
                    whole = Fact(first.subject, declared.iri, second.object)
                    yield whole, (fact, other), axiom


def relation_clashes(
    facts: Facts, forbidden: Iterable[Relation], classes: KnownClasses, model: Model
) -> Iterator[Clash]:
    """Find contradictions between relations that hold and relations that do not hold.

    `classes` are the known classes of individuals.
    """
    for denied in forbidden:
        reason = facts.get(fact_of(denied))
        if reason is not None:
            yield _opposite(denied, reason, model)
    for fact, reason in facts.items():
        declared = model.relations.get(fact.relation)
        if declared is not None and (declared.is_asymmetric or declared.is_irreflexive):
            yield from _wrong_direction(fact, reason, facts, is_asymmetric=declared.is_asymmetric)
    yield from _too_many(facts, classes, model)


def _opposite(denied: Relation, reason: FactReason, model: Model) -> Clash:
    said = reason.said | {denied}
    if not reason.axioms:
        return Clash(said, errors.Contradiction)
    follows = Relation(denied.subject, denied.relation, denied.object)
    why = f"so `{spelled(follows, model)}` follows"
    return Clash(said, world_errors.OppositeFollows, reason.axioms, why)


def _wrong_direction(
    fact: Fact, reason: FactReason, facts: Facts, *, is_asymmetric: bool
) -> Iterator[Clash]:
    """A relation of an individual to itself, or in both directions."""
    back = Fact(fact.object, fact.relation, fact.subject)
    if fact == back:
        kind = "asymmetric" if is_asymmetric else "irreflexive"
        axiom = Axiom(f"{{}} is {kind}: it relates no individual to itself", (fact.relation,))
        whole = joined(reason, axiom=axiom)
        yield Clash(whole.said, world_errors.ToItself, whole.axioms)
    elif is_asymmetric and back in facts:
        text = "{} is asymmetric: it cannot hold in both directions"
        whole = joined(reason, facts[back], axiom=Axiom(text, (fact.relation,)))
        yield Clash(whole.said, world_errors.BothWays, whole.axioms)


def _too_many(facts: Facts, classes: KnownClasses, model: Model) -> Iterator[Clash]:
    """More individuals on one side of a relation than the ontology allows."""
    objects: dict[tuple[str, str], list[Fact]] = defaultdict(list)
    subjects: dict[tuple[str, str], list[Fact]] = defaultdict(list)
    for fact in facts:
        if fact.relation in model.limited:
            objects[fact.relation, fact.subject].append(fact)
            subjects[fact.relation, fact.object].append(fact)
    for (iri, subject), found in objects.items():
        for limit in limits(iri, classes.get(subject, {}), model):
            for fact in found[limit.most :]:
                several = [facts[each] for each in (*found[: limit.most], fact)]
                yield limit.exceeded(several, subject)
    for (iri, individual), (first, *more) in subjects.items():
        if of_subjects := limit_of_subjects(iri, model):
            for fact in more:
                yield of_subjects.exceeded([facts[first], facts[fact]], individual)
