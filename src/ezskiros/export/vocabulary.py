"""The classes and data properties of ontologies in the format of the export.

The export has all classes that a parameter or a permission names, with their subclasses, and the
superclasses of all of these.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from dslkit.diagnostics import listed
from ezskiros import session
from ezskiros.check.values import is_value_of, spelled_types
from ezskiros.export import errors
from ezskiros.export.places import ExportPlaces
from ezskiros.ontology import Ontology
from ezskiros.ontology.iris import RESERVED
from ezskiros.ontology.model import Model
from ezskiros.ontology.places import EntityDeclarations
from ezskiros.ontology.symbols import OntologyClass
from ezskiros.session import NOWHERE
from ezskiros.skills.quantities import UNITS

_SAMPLES = {"float": 0.5, "int": 1, "bool": True, "str": "text"}
"""A sample value of each type, wider number types first."""


class Vocabulary:
    """Some classes of one ontology, with their properties and base classes."""

    def __init__(self, ontology: Ontology, named: Iterable[str], places: ExportPlaces) -> None:
        self._ontology, self._model, self._places = ontology, ontology.model, places
        self._declarations = EntityDeclarations(ontology.documents)
        self._classes = _related(self._model, set(named))

    def classes(self) -> Iterator[dict[str, Any]]:
        """All classes, by name."""
        for iri in self._classes:
            yield {
                "name": name_in(self._ontology, iri),
                "iri": iri,
                "parents": sorted(name_in(self._ontology, each) for each in self._parents(iri)),
                "place": self._place(iri),
            }

    def properties(self) -> Iterator[dict[str, Any]]:
        """The data properties that individuals of these classes can have. Unknown units are
        reported.
        """
        for iri, found in self._model.values.items():
            owners = self._owners(iri)
            if owners is None:
                continue
            name = name_in(self._ontology, iri)
            if found.unit and found.unit not in UNITS:
                wrong = errors.UnknownPropertyUnit(
                    property=name, unit=found.unit, units=listed([*UNITS])
                )
                session.report(wrong.at(self._declarations.place(iri) or NOWHERE))
            yield {
                "name": name,
                "type": type_of(self._model, iri),
                "of": sorted(name_in(self._ontology, each) for each in owners),
                "unit": found.unit or None,
                "place": self._place(iri),
            }

    def _parents(self, iri: str) -> Iterator[str]:
        known = self._model.classes.get(iri)
        if known is not None:
            above = known.parents | known.equivalents
            yield from (each for each in above if each != iri and not each.startswith(RESERVED))

    def _owners(self, iri: str) -> Sequence[str] | None:
        """The most general classes that can have a property. Empty if the ontology does not
        restrict the property, None if only other classes can have it.
        """
        domain = self._model.domain(iri)
        if not domain:
            return ()
        fitting = {
            each
            for each in self._classes
            if all(not union.isdisjoint(self._model.above(each)) for union in domain)
        }
        general = [each for each in fitting if not (self._model.above(each) - {each}) & fitting]
        return general or sorted(fitting) or None

    def _place(self, iri: str) -> dict[str, Any] | None:
        return self._places.of(self._declarations.place(iri))


def name_in(ontology: Ontology, iri: str) -> str:
    """The name in Python, such as `skiros.Product`; the IRI if its namespace has no name."""
    return ontology.spelled.get(iri, iri)


def name_of(owl_class: OntologyClass) -> str:
    """The name in Python of a class of an ontology."""
    ontology = owl_class.vocabulary
    return name_in(ontology, owl_class.iri) if isinstance(ontology, Ontology) else owl_class.iri


def _related(model: Model, named: set[str]) -> list[str]:
    """Some classes, their subclasses, and the superclasses of all of these."""
    below = {each for each in model.classes if not named.isdisjoint(model.above(each))}
    found = named | below
    found |= {above for each in found for above in model.above(each)}
    return sorted(each for each in found if not each.startswith(RESERVED))


def type_of(model: Model, iri: str) -> str:
    """The type of a data property; text if the ontology allows several types."""
    if model.values[iri].values:
        return "str"
    ranges = [*filter(None, map(spelled_types, model.range(iri)))]
    allowed = [
        name
        for name, sample in _SAMPLES.items()
        if all(is_value_of(sample, names) for names in ranges)
    ]
    if allowed == ["float", "int"]:
        return "float"
    return allowed[0] if len(allowed) == 1 else "str"
