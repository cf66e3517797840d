"""Checks of SkiROS2 scene files (`.turtle`), the initial world models, against the ontology."""

from __future__ import annotations

import difflib
import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pyoxigraph

from dslkit.diagnostics import DeclaredHere, Diagnostic, Remark
from dslkit.source import Span
from ezskiros.check import scene_errors as errors
from ezskiros.check.values import is_value_of, spelled_types
from ezskiros.locations import find_locations
from ezskiros.ontology import Ontology
from ezskiros.ontology.iris import AS_WKT, OWL, RDF, RDFS, RESERVED, XSD, split
from ezskiros.ontology.model import ObjectProperty, Union
from ezskiros.ontology.read import Document, read
from ezskiros.ontology.scene_text import place_in, spelled_in

_TYPE = RDF + "type"
_CLASSES = {OWL + "Class", OWL + "class", RDFS + "Class"}
_NUMBERED = re.compile(r"-(\d+)$")


def check_scene(path: Path, ontology: Ontology) -> list[Diagnostic]:
    """Report the mistakes in a scene. Raises `OSError` if the scene cannot be read."""
    document, wrong = read(path)
    if document is None:
        return wrong
    return list(_Scene(document, ontology).check())


@dataclass
class _Individual:
    """The description of one individual in a scene."""

    iri: str
    types: list[str] = field(default_factory=list)
    relations: list[tuple[str, str]] = field(default_factory=list)
    values: list[tuple[str, pyoxigraph.Literal]] = field(default_factory=list)


class _Scene:
    """The checks of one scene."""

    def __init__(self, document: Document, ontology: Ontology) -> None:
        self._document = document
        self._ontology, self._model = ontology, ontology.model
        self._individuals = _individuals(document)
        declared = (iri for iri, each in self._individuals.items() if _CLASSES & set(each.types))
        self._own_classes = set(declared)

    def check(self) -> Iterator[Diagnostic]:
        for individual in self._individuals.values():
            if individual.iri in self._own_classes:
                continue
            yield from self._types(individual)
            yield from self._relations(individual)
            yield from self._values(individual)
            yield from self._missing(individual)
        yield from self._numbers()
        yield from self._functional()
        yield from find_locations(self._document, self._model).diagnostics

    # --- one individual ---------------------------------------------------------------------------

    def _types(self, individual: _Individual) -> Iterator[Diagnostic]:
        for kind in individual.types:
            if (
                kind.startswith(RESERVED)
                or kind in self._model.classes
                or kind in self._own_classes
            ):
                continue
            found = errors.UnknownSceneClass(
                individual=self._spelled(individual.iri), owl_class=self._spelled(kind)
            )
            yield found.at(
                self._place(individual.iri, kind), help=self._meant(kind, self._model.classes)
            )

    def _relations(self, individual: _Individual) -> Iterator[Diagnostic]:
        for iri, other in individual.relations:
            if iri.startswith(RESERVED):
                continue
            if iri not in self._model.relations:
                yield self._no_relation(individual, iri, other)
            elif other not in self._individuals and other not in self._model.individuals:
                found = errors.UnknownIndividual(
                    individual=self._spelled(individual.iri),
                    property=self._spelled(iri),
                    other=self._spelled(other),
                )
                near = self._meant(other, self._individuals)
                yield found.at(self._place(individual.iri, other), help=near)
            else:
                related = (individual.iri, other)
                yield from self._fits(individual.iri, iri, self._model.domain(iri), related)
                yield from self._fits(other, iri, self._model.range(iri), related)

    def _no_relation(self, individual: _Individual, iri: str, other: str) -> Diagnostic:
        place = self._place(individual.iri, iri)
        if iri in self._model.values:
            return errors.KindOfProperty(
                property=self._spelled(iri),
                kind="data property",
                individual=self._spelled(individual.iri),
                found=f"the individual {self._spelled(other)}",
            ).at(place)
        found = errors.UnknownSceneProperty(
            property=self._spelled(iri), individual=self._spelled(individual.iri)
        )
        return found.at(place, help=self._meant(iri, self._model.relations))

    def _fits(
        self, iri: str, relation: str, wanted: tuple[Union, ...], related: tuple[str, str]
    ) -> Iterator[Diagnostic]:
        types = self._classes_of(iri)
        for union in wanted:
            if types and not any(self._model.is_a(each, one) for each in types for one in union):
                found = errors.SceneDoesNotFit(
                    individual=self._spelled(iri),
                    found=" and ".join(map(self._spelled, types)),
                    property=self._spelled(relation),
                    wanted=" or ".join(map(self._spelled, sorted(union))),
                )
                label = self._ontology.label(relation, found.Relates())
                yield found.at(self._place(*related), *([label] if label else []))
                return

    def _classes_of(self, iri: str) -> list[str]:
        """The known classes of an individual of the scene or of the ontology."""
        if iri in self._individuals:
            return [each for each in self._individuals[iri].types if each in self._model.classes]
        found = self._model.individuals.get(iri)
        return sorted(found.types) if found else []

    def _values(self, individual: _Individual) -> Iterator[Diagnostic]:
        for iri, value in individual.values:
            if iri.startswith(RESERVED) or iri == AS_WKT:
                continue
            if iri in self._model.relations:
                yield errors.KindOfProperty(
                    property=self._spelled(iri),
                    kind="relation",
                    individual=self._spelled(individual.iri),
                    found=f"the value {value.value!r}",
                ).at(self._place(individual.iri, iri))
            elif iri not in self._model.values:
                found = errors.UnknownSceneProperty(
                    property=self._spelled(iri), individual=self._spelled(individual.iri)
                )
                yield found.at(
                    self._place(individual.iri, iri), help=self._meant(iri, self._model.values)
                )
            else:
                yield from self._value(individual, iri, value)

    def _value(
        self, individual: _Individual, iri: str, value: pyoxigraph.Literal
    ) -> Iterator[Diagnostic]:
        declared = self._model.values[iri]
        wanted = [spelled_types(union) for union in self._model.range(iri)]
        if declared.values is not None and value.value not in declared.values:
            wanted.append(declared.values)
        elif all(not names or _is_of(value, names) for names in wanted):
            return
        found = errors.WrongSceneValue(
            property=self._spelled(iri),
            individual=self._spelled(individual.iri),
            found=f"{value.value!r} ({value.datatype.value.removeprefix(XSD)})",
            wanted=" or ".join(sorted({name for names in wanted for name in names})),
        )
        label = self._ontology.label(iri, DeclaredHere())
        yield found.at(self._place(individual.iri, iri), *([label] if label else []))

    def _missing(self, individual: _Individual) -> Iterator[Diagnostic]:
        above = {
            each for kind in self._classes_of(individual.iri) for each in self._model.above(kind)
        }
        for kind in sorted(above & set(self._model.classes)):
            for iri, unions in self._model.classes[kind].some.items():
                for union in unions:
                    if not self._has(individual, iri, union):
                        yield errors.MissingRelation(
                            individual=self._spelled(individual.iri),
                            wanted=" or ".join(map(self._spelled, sorted(union))),
                            property=self._spelled(iri),
                            owl_class=self._spelled(kind),
                        ).at(self._place(individual.iri))

    def _has(self, individual: _Individual, iri: str, union: Union) -> bool:
        others = (
            other
            for relation, other in individual.relations
            if iri in self._model.properties_above(relation)
        )
        return any(
            self._model.is_a(kind, wanted)
            for other in others
            for kind in self._classes_of(other)
            for wanted in union
        )

    # --- all individuals --------------------------------------------------------------------------

    def _numbers(self) -> Iterator[Diagnostic]:
        seen: dict[str, str] = {}
        for iri in self._individuals:
            if not (match := _NUMBERED.search(iri)):
                continue
            other = seen.setdefault(match[1], iri)
            if other != iri:
                found = errors.RepeatedNumber(
                    individual=self._spelled(iri), other=self._spelled(other)
                )
                yield found.at(self._place(iri), found.Other().at(self._place(other)))

    def _functional(self) -> Iterator[Diagnostic]:
        objects: dict[tuple[str, str], list[str]] = defaultdict(list)
        subjects: dict[tuple[str, str], list[str]] = defaultdict(list)
        for individual in self._individuals.values():
            for iri, other in individual.relations:
                declared = self._model.relations.get(iri)
                if declared is not None:
                    _note(objects, subjects, declared, individual.iri, other)
        for found in (objects, subjects):
            for (one, iri), (first, *more) in found.items():
                for second in more:
                    yield errors.TwoObjects(
                        individual=self._spelled(one),
                        property=self._spelled(iri),
                        first=self._spelled(first),
                        second=self._spelled(second),
                        kind="functional" if found is objects else "inverse functional",
                    ).at(self._place(one if found is objects else second))

    # --- words and places -------------------------------------------------------------------------

    def _spelled(self, iri: str) -> str:
        return spelled_in(self._document, iri, self._model)

    def _meant(self, iri: str, known: object) -> Remark | None:
        """The help with the known name that is most similar."""
        names = {split(each)[1]: each for each in known} if hasattr(known, "__iter__") else {}
        near = difflib.get_close_matches(split(iri)[1], names, n=1, cutoff=0.7)
        return errors.Near(near=self._spelled(names[near[0]])) if near else None

    def _place(self, subject: str, *parts: str) -> Span:
        return place_in(self._document, self._model, subject, *parts)


def _individuals(document: Document) -> dict[str, _Individual]:
    """The individuals that a scene describes, in the order of the file."""
    found: dict[str, _Individual] = {}
    for triple in document.triples:
        if not isinstance(triple.subject, pyoxigraph.NamedNode):
            continue
        individual = found.setdefault(triple.subject.value, _Individual(triple.subject.value))
        match triple.object:
            case pyoxigraph.NamedNode(value=value) if triple.predicate.value == _TYPE:
                individual.types.append(value)
            case pyoxigraph.NamedNode(value=value):
                individual.relations.append((triple.predicate.value, value))
            case pyoxigraph.Literal():
                individual.values.append((triple.predicate.value, triple.object))
            case _:  # open: a blank node
                pass
    return found


def _note(
    objects: dict[tuple[str, str], list[str]],
    subjects: dict[tuple[str, str], list[str]],
    declared: ObjectProperty,
    subject: str,
    other: str,
) -> None:
    """Record a statement with a relation that allows only one."""
    if declared.is_functional:
        objects[subject, declared.iri].append(other)
    if declared.is_inverse_functional:
        subjects[other, declared.iri].append(subject)


def _is_of(value: pyoxigraph.Literal, names: frozenset[str]) -> bool:
    """Say whether a literal is of one of these types, both by its declared type and by its text."""
    kind = value.datatype.value.removeprefix(XSD)
    try:
        if kind in {"float", "double", "decimal"}:
            return is_value_of(float(value.value), names)
        if kind in {"integer", "int", "long"}:
            return is_value_of(int(value.value), names)
    except ValueError:
        return False
    if kind == "boolean":
        return is_value_of(value.value == "true", names)
    return is_value_of(value.value, names)
