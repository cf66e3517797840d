"""The world model interface of primitive skills: `self.world.relate(gripper, skiros.at, pose)`."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

from ezskiros.engine.values import WorldIndividual
from ezskiros.engine.world import World
from ezskiros.ontology.model import Model
from ezskiros.ontology.statements import Value
from ezskiros.ontology.symbols import OntologyClass
from ezskiros.ontology.world import PropertyOf

OwlClass = OntologyClass | str
OwlProperty = PropertyOf | str


class WorldModel:
    """The existing individuals, and the relations between them.

    Classes and properties are those of the ontology, such as `skiros.at`, or texts, such as
    "skiros:at". Raises `LookupError` for names that the ontology does not have.
    """

    def __init__(self, world: World) -> None:
        self._world = world

    # --- queries --------------------------------------------------------------------------------

    def individual(self, name: str) -> WorldIndividual:
        """The individual with a name, such as `skiros:Location-3`, a label or an IRI.

        Raises `LookupError` if there is none, or if there are several.
        """
        found = self._world.named(name)
        if len(found) == 1:
            return WorldIndividual(found[0], self._world)
        shown = ", ".join(map(self._world.spelled, found))
        raise LookupError(f"{name!r} is {shown}" if found else f"there is no {name!r} in the world")

    def individuals(self, owl_class: OwlClass) -> list[WorldIndividual]:
        """All individuals of a class or its subclasses, by name."""
        return self._made(self._world.individuals(self._class(owl_class)))

    def is_a(self, individual: WorldIndividual, owl_class: OwlClass) -> bool:
        """Say whether an individual is of a class or its subclasses."""
        return self._world.is_a(individual.iri, self._class(owl_class))

    def are_related(
        self, subject: WorldIndividual, relation: OwlProperty, other: WorldIndividual
    ) -> bool:
        """Say whether a relation holds, directly or as a consequence of other facts."""
        return self._world.are_related(subject.iri, self._relation(relation), other.iri)

    def related(self, subject: WorldIndividual, relation: OwlProperty) -> list[WorldIndividual]:
        """The objects of a relation with this subject, by name."""
        return self._made(self._world.related(subject.iri, self._relation(relation)))

    def relating(self, relation: OwlProperty, other: WorldIndividual) -> list[WorldIndividual]:
        """The subjects of a relation with this object, by name."""
        return self._made(self._world.relating(self._relation(relation), other.iri))

    def values(self, individual: WorldIndividual, data_property: OwlProperty) -> list[Value]:
        """The values of a data property."""
        return self._world.values(individual.iri, self._data_property(data_property))

    # --- changes ----------------------------------------------------------------------------------

    def relate(
        self, subject: WorldIndividual, relation: OwlProperty, other: WorldIndividual
    ) -> None:
        """Make a relation true. If the relation allows only one subject or object, the previous one
        is removed.
        """
        self._world.relate(subject.iri, self._relation(relation), other.iri)

    def unrelate(
        self, subject: WorldIndividual, relation: OwlProperty, other: WorldIndividual
    ) -> None:
        """Make a relation false, including all facts that imply it."""
        self._world.unrelate(subject.iri, self._relation(relation), other.iri)

    def set_value(
        self, individual: WorldIndividual, data_property: OwlProperty, value: Value
    ) -> None:
        """Set a data property to this only value."""
        self._world.set_value(individual.iri, self._data_property(data_property), value)

    def unset(self, individual: WorldIndividual, data_property: OwlProperty) -> None:
        """Remove all values of a data property."""
        self._world.unset(individual.iri, self._data_property(data_property))

    def new(self, owl_class: OwlClass) -> WorldIndividual:
        """A new individual of a class, with a name as in SkiROS2: the class and a number."""
        return WorldIndividual(self._world.new(self._class(owl_class)), self._world)

    def remove(self, individual: WorldIndividual) -> None:
        """Remove an individual and all facts about it."""
        self._world.remove(individual.iri)

    # --- names ------------------------------------------------------------------------------------

    @property
    def _model(self) -> Model:
        return self._world.ontology.model

    def _made(self, iris: list[str]) -> list[WorldIndividual]:
        return [WorldIndividual(iri, self._world) for iri in iris]

    def _class(self, named: OwlClass) -> str:
        if isinstance(named, OntologyClass):
            return named.iri
        return self._known(named, self._model.classes, "class")

    def _relation(self, named: OwlProperty) -> str:
        return self._known(_iri(named), self._model.relations, "relation")

    def _data_property(self, named: OwlProperty) -> str:
        return self._known(_iri(named), self._model.values, "data property")

    def _known(self, named: str, known: Iterable[str], kind: str) -> str:
        """An IRI, given as IRI or as `prefix:Name`. Raises `LookupError` for an unknown name."""
        prefix, _, rest = named.partition(":")
        iri = f"{self._model.names[prefix]}{rest}" if prefix in self._model.names else named
        iris = [*known]
        if iri in iris:
            return iri
        near = difflib.get_close_matches(iri, iris, n=1, cutoff=0.7)
        hint = f"; did you mean {self._model.short(near[0])}?" if near else ""
        raise LookupError(f"the ontology has no {kind} {self._model.short(iri)!r}{hint}")


def _iri(named: OwlProperty) -> str:
    return named.iri if isinstance(named, PropertyOf) else named
