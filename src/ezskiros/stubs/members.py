"""The attributes of the individuals of each class, and their meaning.

The rules are those of `Ontology.attribute` when a description runs, and of the check of relations.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ezskiros.ontology import Ontology
from ezskiros.ontology.iris import RESERVED, THING
from ezskiros.ontology.model import Model, Union
from ezskiros.ontology.symbols import OntologyClass, Thing


@dataclass(frozen=True)
class MemberMeaning:
    """A relation or data property. Its objects or values must be in each union of `wanted`."""

    iri: str
    wanted: tuple[Union, ...] = ()


AMBIGUOUS = MemberMeaning("")
"""The members whose name exists in several namespaces."""


def iri_of(owl_class: OntologyClass) -> str:
    """The IRI of a class, including `Thing`."""
    return THING if owl_class is Thing else owl_class.iri


class OntologyClasses:
    """All classes of an ontology, one per group of equivalent classes. `known` has `Thing` first,
    and each class after its bases.
    """

    def __init__(self, ontology: Ontology) -> None:
        model = ontology.model
        declared = (iri for iri in model.classes if not iri.startswith(RESERVED))
        found = {each for iri in declared for each in _above(ontology.class_of(iri))} | {Thing}
        self.known: Sequence[OntologyClass] = sorted(
            found, key=lambda each: (len(each.__mro__), iri_of(each))
        )
        self._below: dict[str, set[OntologyClass]] = defaultdict(set)
        for each in self.known:
            for iri in model.above(iri_of(each)):
                self._below[iri].add(each)

    def fitting(self, wanted: Iterable[Union]) -> set[OntologyClass]:
        """The classes whose individuals are in all of these unions."""
        found = set(self.known)
        for union in wanted:
            found &= {each for iri in union for each in self._below.get(iri, ())}
        return found

    def widest(self, wanted: Iterable[Union]) -> list[OntologyClass]:
        """The fitting classes, without subclasses of other fitting classes."""
        found = self.fitting(wanted)
        if Thing in found:  # all other classes are below it
            return [Thing]
        return [each for each in found if found.isdisjoint(_above(each)[1:])]


def _above(owl_class: OntologyClass) -> list[OntologyClass]:
    """A class and its base classes, in Python's lookup order."""
    return [each for each in owl_class.__mro__ if isinstance(each, OntologyClass)]


def members(
    ontology: Ontology, classes: OntologyClasses
) -> dict[OntologyClass, dict[str, MemberMeaning]]:
    """The attributes of each class that differ from the inherited ones.

    A class has an attribute if it is in the domain of the relation or data property.
    """
    model = ontology.model
    restricted = {iri for each in model.classes.values() for iri in each.only}
    found: dict[OntologyClass, dict[str, MemberMeaning]] = {each: {} for each in classes.known}
    for name, iris in ontology.properties.items():
        if len(iris) == 1 and iris[0] not in restricted:  # the same for all classes below it
            for each in classes.widest(model.domain(iris[0])):
                found[each][name] = MemberMeaning(iris[0], model.range(iris[0]))
            continue
        fitting = {iri: classes.fitting(model.domain(iri)) for iri in _eligible(model, iris)}
        for each in classes.known:
            meaning = _meaning(model, each, [iri for iri in fitting if each in fitting[iri]])
            inherited = (found[above].get(name) for above in _above(each)[1:])
            if meaning is not None and meaning != next(filter(None, inherited), None):
                found[each][name] = meaning
    return found


def _eligible(model: Model, iris: Sequence[str]) -> Sequence[str]:
    """The properties with one name that their domains can distinguish."""
    return [iri for iri in iris if model.domain(iri)] if len(iris) > 1 else iris


def _meaning(
    model: Model, owl_class: OntologyClass, fitting: Sequence[str]
) -> MemberMeaning | None:
    """The meaning of a name that these properties of a class have; None without any property."""
    if len(fitting) > 1:
        return AMBIGUOUS
    for iri in fitting:
        return MemberMeaning(iri, (*model.range(iri), *_only(model, iri_of(owl_class), iri)))
    return None


def _only(model: Model, owl_class: str, iri: str) -> list[Union]:
    """The statements of a class about all individuals in this relation."""
    above = sorted(each for each in model.above(owl_class) if each in model.classes)
    return [union for each in above for union in model.classes[each].only.get(iri, ())]
