"""The world model: the existing individuals, and the facts about them.

Facts are triples in a store of pyoxigraph. The ontology determines their consequences: classes from
subclasses, and relations from special cases, inverses, symmetry and transitivity. All names are
IRIs.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from functools import cached_property

import pyoxigraph

from ezskiros.engine.literals import value_of
from ezskiros.ontology import Ontology
from ezskiros.ontology.iris import OWL, RDF, RDFS, XSD, split
from ezskiros.ontology.model import ObjectProperty
from ezskiros.ontology.read import Document
from ezskiros.ontology.statements import Value

_TYPE = RDF + "type"
_LABEL = RDFS + "label"
_NO_CLASS = {OWL + "NamedIndividual"}


class World:
    """Individuals and facts. `load` reads a scene, `turtle` returns one."""

    def __init__(self, ontology: Ontology) -> None:
        self.ontology = ontology
        self._model = ontology.model
        self._store = pyoxigraph.Store()
        self._numbers = itertools.count(1)
        self._known_implying: dict[str, tuple[tuple[str, bool], ...]] = {}
        for iri, individual in self._model.individuals.items():
            for owl_class in individual.types:
                self._add(iri, _TYPE, pyoxigraph.NamedNode(owl_class))

    def load(self, scene: Document) -> None:
        """Add the facts of a scene."""
        self._store.extend(scene.triples)

    def copy(self) -> World:
        """Another world with the same facts."""
        found = World(self.ontology)
        found._store.clear()  # individuals of the ontology may have been removed
        found._store.extend(self._store)
        return found

    def turtle(self) -> str:
        """All facts as Turtle."""
        quads = sorted(self._store, key=_order)
        text = pyoxigraph.serialize(
            (quad.triple for quad in quads),
            format=pyoxigraph.RdfFormat.TURTLE,
            prefixes={**self._model.names, "rdfs": RDFS, "xsd": XSD},
        )
        return (text or b"").decode()

    # --- queries --------------------------------------------------------------------------------

    def individuals(self, owl_class: str) -> list[str]:
        """All individuals of a class or one of its subclasses, by name."""
        found = {
            quad.subject.value
            for quad in self._store.quads_for_pattern(None, pyoxigraph.NamedNode(_TYPE), None)
            if isinstance(quad.subject, pyoxigraph.NamedNode)
            and isinstance(quad.object, pyoxigraph.NamedNode)
            and self._model.is_a(quad.object.value, owl_class)
        }
        return sorted(found, key=_by_name)

    def exists(self, individual: str) -> bool:
        """Say whether an individual exists."""
        return any(self._facts(individual, _TYPE))

    def classes(self, individual: str) -> list[str]:
        """The stated classes of an individual."""
        found = self._facts(individual, _TYPE)
        named = {each.value for each in found if isinstance(each, pyoxigraph.NamedNode)}
        return sorted(named - _NO_CLASS)

    def is_a(self, individual: str, owl_class: str) -> bool:
        """Say whether an individual is of a class."""
        return any(self._model.is_a(each, owl_class) for each in self.classes(individual))

    def labelled(self, label: str) -> list[str]:
        """The individuals with a label (rdfs:label), by name."""
        pattern = self._store.quads_for_pattern(None, pyoxigraph.NamedNode(_LABEL), None)
        found = (
            quad.subject.value
            for quad in pattern
            if isinstance(quad.subject, pyoxigraph.NamedNode)
            and isinstance(quad.object, pyoxigraph.Literal)
            and quad.object.value == label
        )
        return sorted(found, key=_by_name)

    def are_related(self, subject: str, relation: str, other: str) -> bool:
        """Say whether a relation holds, directly or as a consequence of other facts."""
        if self._is_transitive(relation):
            return other in self.related(subject, relation)
        return any(
            self._has(subject, each, other) if is_forward else self._has(other, each, subject)
            for each, is_forward in self._implying(relation)
        )

    def related(self, subject: str, relation: str) -> list[str]:
        """The objects of a relation with this subject, by name."""
        return self._reached(subject, relation, is_from_subject=True)

    def relating(self, relation: str, other: str) -> list[str]:
        """The subjects of a relation with this object, by name."""
        return self._reached(other, relation, is_from_subject=False)

    def values(self, individual: str, data_property: str) -> list[Value]:
        """The values of a data property."""
        return [
            value_of(term)
            for each in self._properties(data_property)
            for term in self._facts(individual, each)
            if isinstance(term, pyoxigraph.Literal)
        ]

    # --- changes ----------------------------------------------------------------------------------

    def new(self, owl_class: str) -> str:
        """A new individual of a class, with a name as in SkiROS2: the class and a number."""
        taken = {each.rpartition("-")[2] for each in self._named()}
        number = next(each for each in self._numbers if str(each) not in taken)
        individual = f"{owl_class}-{number}"
        self._add(individual, _TYPE, pyoxigraph.NamedNode(owl_class))
        return individual

    def remove(self, individual: str) -> None:
        """Remove an individual and all facts about it."""
        node = pyoxigraph.NamedNode(individual)
        for quad in [
            *self._store.quads_for_pattern(node, None, None),
            *self._store.quads_for_pattern(None, None, node),
        ]:
            self._store.remove(quad)

    def set_class(self, individual: str, owl_class: str) -> None:
        """Add a class to an individual."""
        self._add(individual, _TYPE, pyoxigraph.NamedNode(owl_class))

    def relate(self, subject: str, relation: str, other: str) -> None:
        """Make a relation true. If the relation allows only one subject or object, the previous one
        is removed.
        """
        for each in sorted(self._model.properties_above(relation)):
            declared = self._model.relations.get(each)
            if declared is None:
                continue
            if self._is_functional(declared, is_inverse=False):
                for before in self.related(subject, each):
                    self.unrelate(subject, each, before)
            if self._is_functional(declared, is_inverse=True):
                for before in self.relating(each, other):
                    self.unrelate(before, each, other)
        self._add(subject, relation, pyoxigraph.NamedNode(other))

    def unrelate(self, subject: str, relation: str, other: str) -> None:
        """Make a relation false, including all facts that imply it."""
        for each, is_forward in self._implying(relation):
            ends = (subject, other) if is_forward else (other, subject)
            self._forget(ends[0], each, ends[1])

    def set_value(self, individual: str, data_property: str, value: Value) -> None:
        """Set a data property to this only value."""
        self.unset(individual, data_property)
        self._add(individual, data_property, pyoxigraph.Literal(value))

    def set_some_value(self, individual: str, data_property: str) -> None:
        """Set a data property to any value that the ontology allows."""
        self.set_value(individual, data_property, self._some_value(data_property))

    def unset(self, individual: str, data_property: str) -> None:
        """Remove all values of a data property."""
        for each in self._properties(data_property):
            self._forget(individual, each, None)

    # --- statements of the ontology ---------------------------------------------------------------

    def _some_value(self, data_property: str) -> Value:
        model = self.ontology.model
        declared = model.values.get(data_property)
        if declared is not None and declared.values:
            return min(declared.values)
        kinds = {name.rpartition("#")[2] for union in model.range(data_property) for name in union}
        if kinds & {"float", "double", "decimal"}:
            return 0.0
        if kinds & {"integer", "int", "long"}:
            return 0
        return True if "boolean" in kinds else "simulated"

    def _implying(self, relation: str) -> tuple[tuple[str, bool], ...]:
        """The relations that imply a relation, each with whether it has the same direction."""
        if relation not in self._known_implying:
            self._known_implying[relation] = tuple(dict.fromkeys(self._found_implying(relation)))
        return self._known_implying[relation]

    def _found_implying(self, relation: str) -> Iterator[tuple[str, bool]]:
        yield relation, True
        for iri, declared in self._model.relations.items():
            above = self._model.properties_above(iri)
            if relation in above:
                yield iri, True
            if any(relation in self._model.properties_above(each) for each in declared.inverses):
                yield iri, False
            if declared.is_symmetric and relation in above:
                yield iri, False

    def _is_transitive(self, relation: str) -> bool:
        declared = self._model.relations.get(relation)
        return declared is not None and declared.is_transitive

    def _is_functional(self, declared: ObjectProperty, *, is_inverse: bool) -> bool:
        """Say whether a relation has at most one object for a subject; with `is_inverse`, one
        subject for an object.
        """
        turned = [self._model.relations.get(each) for each in declared.inverses]
        others = [each for each in turned if each is not None]
        if declared.is_symmetric:
            others.append(declared)
        if is_inverse:
            return declared.is_inverse_functional or any(each.is_functional for each in others)
        return declared.is_functional or any(each.is_inverse_functional for each in others)

    def _properties(self, data_property: str) -> Iterator[str]:
        """A data property and its subproperties."""
        yield data_property
        for iri in self._model.values:
            if iri != data_property and data_property in self._model.properties_above(iri):
                yield iri

    # --- the store --------------------------------------------------------------------------------

    def _reached(self, start: str, relation: str, *, is_from_subject: bool) -> list[str]:
        """The individuals one step away; for transitive relations, any number of steps away."""
        found: dict[str, None] = {}
        work = [start]
        while work:
            steps = [*self._steps(work.pop(), relation, is_from_subject)]
            if self._is_transitive(relation):
                work += [each for each in steps if each not in found]
            found.update(dict.fromkeys(steps))
        return sorted(found, key=_by_name)

    def _steps(self, individual: str, relation: str, is_from_subject: bool) -> Iterator[str]:
        node = pyoxigraph.NamedNode(individual)
        for each, is_forward in self._implying(relation):
            link = pyoxigraph.NamedNode(each)
            is_subject = is_forward is is_from_subject
            ends = (node, None) if is_subject else (None, node)
            for quad in self._store.quads_for_pattern(ends[0], link, ends[1]):
                end = quad.object if is_subject else quad.subject
                if isinstance(end, pyoxigraph.NamedNode):
                    yield end.value

    def _named(self) -> Iterator[str]:
        link = pyoxigraph.NamedNode(_TYPE)
        for quad in self._store.quads_for_pattern(None, link, None):
            if isinstance(quad.subject, pyoxigraph.NamedNode):
                yield quad.subject.value

    def _facts(self, subject: str, predicate: str) -> Iterator[object]:
        node, link = pyoxigraph.NamedNode(subject), pyoxigraph.NamedNode(predicate)
        return (quad.object for quad in self._store.quads_for_pattern(node, link, None))

    def _has(self, subject: str, predicate: str, other: str) -> bool:
        node, link, end = map(pyoxigraph.NamedNode, (subject, predicate, other))
        return pyoxigraph.Quad(node, link, end) in self._store

    def _add(
        self, subject: str, predicate: str, term: pyoxigraph.NamedNode | pyoxigraph.Literal
    ) -> None:
        node, link = pyoxigraph.NamedNode(subject), pyoxigraph.NamedNode(predicate)
        self._store.add(pyoxigraph.Quad(node, link, term))

    def _forget(self, subject: str, predicate: str, other: str | None) -> None:
        node, link = pyoxigraph.NamedNode(subject), pyoxigraph.NamedNode(predicate)
        end = None if other is None else pyoxigraph.NamedNode(other)
        for quad in [*self._store.quads_for_pattern(node, link, end)]:
            self._store.remove(quad)

    # --- names ------------------------------------------------------------------------------------

    @cached_property
    def _prefixes(self) -> dict[str, str]:
        return {start: short for short, start in self._model.names.items()}

    def spelled(self, iri: str) -> str:
        """The name of an IRI, such as `skiros:Location-3`."""
        start, name = split(iri)
        return f"{self._prefixes[start]}:{name}" if start in self._prefixes else iri

    def label(self, individual: str) -> str | None:
        """The first label of an individual."""
        found = self._facts(individual, _LABEL)
        labels = (each.value for each in found if isinstance(each, pyoxigraph.Literal))
        return min(labels, default=None)

    def named(self, name: str) -> list[str]:
        """The individuals that a name can mean: `skiros:Location-3`, an IRI or a label."""
        short, _, rest = name.partition(":")
        iri = f"{self._model.names[short]}{rest}" if short in self._model.names else name
        return [iri] if _is_iri(iri) and self.exists(iri) else self.labelled(name)


def _by_name(iri: str) -> tuple[str, int]:
    """A sort key by which `Product-7` comes before `Product-10`."""
    name, _, number = iri.rpartition("-")
    return (name, int(number)) if number.isdecimal() else (iri, 0)


def _is_iri(text: str) -> bool:
    try:
        pyoxigraph.NamedNode(text)
    except ValueError:
        return False
    return True


def _order(quad: pyoxigraph.Quad) -> tuple[str, bool, str, str]:
    """A sort key by which types come first among the facts about an individual."""
    link = quad.predicate.value
    return str(quad.subject), link != _TYPE, link, str(quad.object)
