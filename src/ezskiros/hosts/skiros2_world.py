"""SkiROS2's world model with the methods of EzSkiROS's world model, for primitive skills."""

from __future__ import annotations

from collections.abc import Iterable
from copy import deepcopy
from typing import Any

from ezskiros.engine.world import World
from ezskiros.hosts.skiros2_api import api
from ezskiros.ontology import Ontology
from ezskiros.ontology.statements import Value


class HostedWorld(World):
    """Individuals by IRI, without a store in EzSkiROS. `wmi` is SkiROS2's interface."""

    def __init__(self, wmi: Any, ontology: Ontology) -> None:
        # The store of the base class is not created.
        self.ontology = ontology
        self.changed: set[str] = set()
        """Individuals whose facts have changed."""
        self._wmi, self._model = wmi, ontology.model

    # --- queries --------------------------------------------------------------------------------

    def individuals(self, owl_class: str) -> list[str]:
        """All individuals of a class or one of its subclasses, sorted."""
        found = self._wmi.resolve_elements(api().Element(self._model.short(owl_class)))
        return sorted(self.iri(each.id) for each in found or ())

    def exists(self, individual: str) -> bool:
        """Say whether an individual exists."""
        try:
            return bool(self.element(individual))
        except Exception as problem:
            if (
                type(problem).__name__ != "WmException"
            ):  # SkiROS2's exception for a missing individual
                raise
            return False

    def is_a(self, individual: str, owl_class: str) -> bool:
        """Say whether an individual is of a class."""
        return self._model.is_a(self.classes(individual)[0], owl_class)

    def classes(self, individual: str) -> list[str]:
        """The class of an individual."""
        return [self.iri(self.element(individual).type)]

    def related(self, subject: str, relation: str) -> list[str]:
        """The objects of a relation with this subject, sorted."""
        return sorted(other for _, _, other in self._relations(subject, relation, ""))

    def relating(self, relation: str, other: str) -> list[str]:
        """The subjects of a relation with this object, sorted."""
        return sorted(subject for subject, _, _ in self._relations("", relation, other))

    def are_related(self, subject: str, relation: str, other: str) -> bool:
        """Say whether a relation holds."""
        return bool(self._wmi.get_relations(*map(self._model.short, (subject, relation, other))))

    def values(self, individual: str, data_property: str) -> list[Value]:
        """The values of a data property."""
        name = self._model.short(data_property)
        element = self.element(individual)
        return list(element.getProperty(name).values) if element.hasProperty(name) else []

    # --- changes ----------------------------------------------------------------------------------

    def new(self, owl_class: str) -> str:
        """A new individual of a class."""
        return self.iri(self._wmi.add_element(api().Element(self._model.short(owl_class))).id)

    def remove(self, individual: str) -> None:
        """Remove an individual and all facts about it."""
        self._wmi.remove_element(self.element(individual), recursive=False)
        self._forget_them([individual])

    def relate(self, subject: str, relation: str, other: str) -> None:
        """Make a relation true. If the relation allows only one subject or object, the previous one
        is removed, as in EzSkiROS's engine; SkiROS2 itself keeps both.
        """
        for each in sorted(self._model.properties_above(relation)):
            declared = self._model.relations.get(each)
            if declared is None:
                continue
            if self._is_functional(declared, is_inverse=False):
                self._unrelate_all(subject, each, "")
            if self._is_functional(declared, is_inverse=True):
                self._unrelate_all("", each, other)
        self._set(subject, relation, other, value=True)

    def unrelate(self, subject: str, relation: str, other: str) -> None:
        """Make a relation false."""
        self._set(subject, relation, other, value=False)

    def set_value(self, individual: str, data_property: str, value: Value) -> None:
        """Set a data property to this only value."""
        element = deepcopy(self.element(individual))
        element.setProperty(self._model.short(data_property), value)
        self._wmi.update_element_properties(element)
        self._forget_them([individual])

    def unset(self, individual: str, data_property: str) -> None:
        """Remove all values of a data property."""
        element = deepcopy(self.element(individual))
        name = self._model.short(data_property)
        if element.hasProperty(name):
            element.removeProperty(name)
            self._wmi.update_element_properties(element)
            self._forget_them([individual])

    # --- names ------------------------------------------------------------------------------------

    def spelled(self, iri: str) -> str:
        """The SkiROS2 name, such as `skiros:Location-3`."""
        return self._model.short(iri)

    def iri(self, spelled: str) -> str:
        """The IRI of an individual with a SkiROS2 name such as `skiros:Location-3`."""
        prefix, _, name = spelled.partition(":")
        return self._model.names[prefix] + name if prefix in self._model.names else spelled

    def label(self, individual: str) -> str | None:
        """The label of an individual."""
        return self.element(individual).label or None

    def labelled(self, label: str) -> list[str]:
        """The individuals with a label, sorted."""
        # SkiROS2 has none of the class owl:Thing; without a class it searches all.
        found = self._wmi.resolve_elements(api().Element("", label)) if label else ()
        return sorted({self.iri(each.id) for each in found or () if each.label == label})

    # --- the world model --------------------------------------------------------------------------

    def element(self, individual: str) -> Any:
        """The SkiROS2 element of an individual."""
        return self._wmi.get_element(self._model.short(individual))

    def written(self, element: Any) -> Any:
        """Write an element to the world model, which may not contain it yet, and return its new
        state.
        """
        if element.isAbstract():
            return self._wmi.add_element(element)
        self._wmi.update_element(element)
        self._forget_them([self.iri(element.id)])
        return self._wmi.get_element(element.id)

    def _unrelate_all(self, subject: str, relation: str, other: str) -> None:
        for found in self._relations(subject, relation, other):
            self.unrelate(*found)

    def _relations(self, subject: str, relation: str, other: str) -> list[tuple[str, str, str]]:
        """The relations of an individual: one end is given, the other one is empty.

        SkiROS2 stores each relation in both individuals, with "-1" for the individual itself.
        """
        individual = subject or other
        kinds = self._wmi.get_sub_properties(self._model.short(relation))
        ends = ("-1", kinds, "") if subject else ("", kinds, "-1")
        return [
            (
                self._end(each["src"], individual),
                self.iri(each["type"]),
                self._end(each["dst"], individual),
            )
            for each in self.element(individual).getRelations(*ends)
        ]

    def _end(self, spelled: str, own: str) -> str:
        return own if spelled == "-1" else self.iri(spelled)

    def _set(self, subject: str, relation: str, other: str, *, value: bool) -> None:
        self._wmi.set_relation(*map(self._model.short, (subject, relation, other)), value)
        self._forget_them([subject, other])

    def _forget_them(self, individuals: Iterable[str]) -> None:
        """Discard cached individuals that have changed. SkiROS2 keeps the old state until the
        change is reported, which is after it has checked conditions.
        """
        known: dict[str, Any] = getattr(self._wmi, "_elements_cache", {})
        for individual in individuals:
            self.changed.add(individual)
            known.pop(self._model.short(individual), None)
