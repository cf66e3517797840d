"""The classes that the conditions require of an individual, and the disjoint classes among them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from itertools import combinations
from typing import NamedTuple, TypeAlias

from ezskiros.check.clash import Clash, FactReason, KnownClasses, joined
from ezskiros.check.entailed import Facts
from ezskiros.check.spelled import spelled_iri
from ezskiros.check.world_errors import ImpossibleIndividual
from ezskiros.ontology.model import Model, Union

IsReported: TypeAlias = Callable[[str, Union], bool]


class Need(NamedTuple):
    """The reason why an individual must belong to one of some classes, for example the declaration
    of a relation.
    """

    reasons: tuple[FactReason, ...]
    relation: tuple[str, ...] = ()


def class_clashes(
    facts: Facts, classes: KnownClasses, model: Model, is_reported: IsReported | None = None
) -> Iterator[Clash]:
    """Individuals for which no individual can have all required classes.

    Classes that are empty by themselves are a fault of the ontology. `is_reported` knows the needs
    that the class of a parameter does not fit, because `check_relations` reports them.
    """
    if not model.has_disjoint_classes:
        return
    for individual, needs in _needs(facts, classes, model).items():
        for one, other in combinations(needs, 2):
            if model.exclude(one, other) and not (
                is_reported and (is_reported(individual, one) or is_reported(individual, other))
            ):
                first, second = (_named(each, model) for each in (one, other))
                both = f"`{individual}` would be a {first} and a {second}"
                why = f"{both}, and these classes are disjoint"
                whole = joined(*needs[one].reasons, *needs[other].reasons)
                iris = (*needs[one].relation, *needs[other].relation)
                yield Clash(whole.said, ImpossibleIndividual, whole.axioms, why, iris, individual)


def _needs(facts: Facts, classes: KnownClasses, model: Model) -> Mapping[str, Mapping[Union, Need]]:
    """The needs of each individual. The class of the parameter comes first."""
    found: dict[str, dict[Union, Need]] = defaultdict(dict)
    for individual, known in classes.items():
        for owl_class, reason in known.items():
            found[individual].setdefault(frozenset({owl_class}), Need((reason,)))
    for fact, reason in facts.items():
        declared = model.relations.get(fact.relation)
        if declared is None:
            continue
        for union in declared.domain:
            found[fact.subject].setdefault(union, Need((reason,), (declared.iri,)))
        for union in declared.range:
            found[fact.object].setdefault(union, Need((reason,), (declared.iri,)))
        for owl_class, why in classes.get(fact.subject, {}).items():
            for union in model.only(owl_class, fact.relation):
                found[fact.object].setdefault(union, Need((reason, why), (owl_class,)))
    return found


def _named(union: Union, model: Model) -> str:
    return " or ".join(spelled_iri(each, model) for each in sorted(union))
