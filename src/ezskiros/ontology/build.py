"""Conversion of triples to a `Model`."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property

import pyoxigraph

from ezskiros.ontology.iris import NOTHING, OWL, RDF, RDFS, RESERVED, split, stem
from ezskiros.ontology.model import (
    DataProperty,
    Individual,
    Model,
    ObjectProperty,
    OwlClass,
    Property,
    Union,
)
from ezskiros.ontology.read import Document

Node = "pyoxigraph.NamedNode | pyoxigraph.BlankNode"

_TYPE = RDF + "type"
_CLASSES = (OWL + "Class", RDFS + "Class")
_DATA_PROPERTY = OWL + "DatatypeProperty"
_RELATION = OWL + "ObjectProperty"
_UNIT = "unit"
_KINDS = {*_CLASSES, _DATA_PROPERTY, _RELATION, OWL + "Ontology", OWL + "NamedIndividual"}


def build(documents: Sequence[Document]) -> Model:
    """The model of several documents together."""
    graph = Graph(documents)
    classes = {iri: _owl_class(graph, iri) for iri in graph.of_types(*_CLASSES)}
    relations = {iri: _relation(graph, iri) for iri in graph.of_types(_RELATION, *_OF_RELATIONS)}
    values = {iri: _data_property(graph, iri) for iri in graph.of_types(_DATA_PROPERTY)}
    individuals = {each.iri: each for each in _individuals(graph)}
    declared = [*classes, *relations, *values, *individuals]
    return Model(
        classes=_with_both_sides(classes),
        relations=_turned_both_ways(relations),
        values=values,
        individuals=individuals,
        names=names(declared, documents),
    )


def names(entities: Iterable[str], documents: Sequence[Document]) -> dict[str, str]:
    """Short names of the namespaces with declarations.

    As in SkiROS2, a namespace is named after its file, in lower case. If two names would be equal,
    the later namespace is named after the prefix that a file declares for it.
    """
    found: dict[str, str] = {}
    starts = dict.fromkeys(split(iri)[0] for iri in entities)
    for start in sorted(starts):
        if start.startswith(RESERVED) or not start:
            continue
        declared = [
            prefix
            for document in documents
            for prefix, iri in document.prefixes.items()
            if iri == start and prefix
        ]
        for name in (stem(start), *declared):
            if name and name not in found:
                found[name] = start
                break
    return found


class Graph:
    """Triples by subject and predicate. Nodes are IRIs, or blank nodes with the prefix `_:`."""

    def __init__(self, documents: Iterable[Document]) -> None:
        self._found: dict[str, dict[str, list[str]]] = defaultdict(lambda: defaultdict(list))
        self._typed: dict[str, dict[str, None]] = defaultdict(dict)
        for number, document in enumerate(documents):
            for triple in document.triples:
                subject, value = _name(triple.subject, number), _name(triple.object, number)
                predicate = triple.predicate.value
                self._found[subject][predicate].append(value)
                if predicate == _TYPE:
                    self._typed[value][subject] = None

    def all(self, subject: str, predicate: str) -> list[str]:
        """The objects of a subject and predicate: nodes, or the texts of literals."""
        return self._found.get(subject, {}).get(predicate, [])

    def annotations(self, subject: str, name: str) -> list[str]:
        """The texts of annotations with a name, in any namespace."""
        known = self._found.get(subject, {}).items()
        texts = [
            text for predicate, found in known if split(predicate)[1] == name for text in found
        ]
        return [text for text in texts if "://" not in text]

    def first(self, subject: str, predicate: str) -> str | None:
        """One of the objects; None if there is none."""
        return next(iter(self.all(subject, predicate)), None)

    def of_types(self, *types: str) -> list[str]:
        """The IRIs that are declared to be of one of these types."""
        found = {iri: None for each in types for iri in self._typed.get(each, ())}
        return [iri for iri in found if not iri.startswith("_:")]

    def items(self, head: str | None) -> Iterator[str]:
        """The members of an RDF list. A circular list ends where it repeats."""
        seen = set()
        while head is not None and head != RDF + "nil" and head not in seen:
            seen.add(head)
            yield from self.all(head, RDF + "first")[:1]
            head = self.first(head, RDF + "rest")

    def comment(self, iri: str) -> str:
        """The comment of the ontology on an entity, in one line."""
        return " ".join((self.first(iri, RDFS + "comment") or "").split())

    @property
    def types(self) -> Mapping[str, Mapping[str, None]]:
        """The individuals of each type."""
        return self._typed

    @cached_property
    def disjoint_groups(self) -> Mapping[str, Sequence[frozenset[str]]]:
        """The owl:AllDisjointClasses groups of each class."""
        found: dict[str, list[frozenset[str]]] = defaultdict(list)
        for group in self._typed.get(OWL + "AllDisjointClasses", ()):
            members = frozenset(self.items(self.first(group, OWL + "members")))
            for member in members:
                found[member].append(members)
        return found

    def named(self, subject: str, predicate: str) -> frozenset[str]:
        """The objects that have an IRI."""
        return frozenset(each for each in self.all(subject, predicate) if not each.startswith("_:"))

    def unions(self, subject: str, predicate: str) -> tuple[Union, ...]:
        """The classes in each declaration of a domain or range, which may be a union of classes."""
        found = (self.union(each) for each in self.all(subject, predicate))
        return tuple(dict.fromkeys(each for each in found if each))

    def union(self, node: str) -> Union:
        """The classes of a union expression; empty for other expressions."""
        if not node.startswith("_:"):
            return frozenset({node})
        members = list(self.items(self.first(node, OWL + "unionOf")))
        parts = [self.union(member) for member in members]
        return frozenset().union(*parts) if parts and all(parts) else frozenset()


def _name(node: object, document: int) -> str:
    """A node name that is unique: blank nodes of different documents differ."""
    if isinstance(node, pyoxigraph.BlankNode):
        return f"_:{document}.{node.value}"
    if isinstance(node, (pyoxigraph.NamedNode, pyoxigraph.Literal)):
        return node.value
    return str(node)


def _owl_class(graph: Graph, iri: str) -> OwlClass:
    parents = graph.all(iri, RDFS + "subClassOf")
    same = graph.all(iri, OWL + "equivalentClass")
    disjoint = graph.named(iri, OWL + "disjointWith") | _all_disjoint(graph, iri)
    return OwlClass(
        iri,
        parents=graph.named(iri, RDFS + "subClassOf")
        | _meets(graph, same)
        | _meets(graph, parents),
        equivalents=graph.named(iri, OWL + "equivalentClass"),
        disjoint=disjoint,
        only=_restrictions(graph, [*parents, *same], OWL + "allValuesFrom"),
        some=_restrictions(graph, [*parents, *same], OWL + "someValuesFrom"),
        most=_most(graph, [*parents, *same]),
        comment=graph.comment(iri),
    )


def _meets(graph: Graph, expressions: Iterable[str]) -> frozenset[str]:
    """The named classes among the parts of intersections."""
    found = set()
    for expression in expressions:
        members = graph.items(graph.first(expression, OWL + "intersectionOf"))
        found |= {member for member in members if not member.startswith("_:")}
    return frozenset(found)


def _all_disjoint(graph: Graph, iri: str) -> frozenset[str]:
    """The other members of the groups of disjoint classes that a class belongs to."""
    return frozenset[str]().union(*graph.disjoint_groups.get(iri, ())) - {iri}


def _restrictions(
    graph: Graph, expressions: Iterable[str], kind: str
) -> dict[str, tuple[Union, ...]]:
    """The required classes of values by property, from restrictions of one `kind`."""
    found: dict[str, list[Union]] = defaultdict(list)
    for each in expressions:
        on, what = graph.first(each, OWL + "onProperty"), graph.first(each, kind)
        if on and what and what != NOTHING and (union := graph.union(what)):
            found[on].append(union)
    return {iri: tuple(unions) for iri, unions in found.items()}


_LIMITS = (OWL + "maxCardinality", OWL + "cardinality")
_LIMITS_OF_DATA = (OWL + "maxQualifiedCardinality", OWL + "qualifiedCardinality")


def _most(graph: Graph, expressions: Iterable[str]) -> dict[str, int]:
    """The maximum number of values by property. Qualified cardinalities give no limit."""
    found: dict[str, int] = {}
    for each in expressions:
        on = graph.first(each, OWL + "onProperty")
        kinds = (*_LIMITS, *(_LIMITS_OF_DATA if graph.all(each, OWL + "onDataRange") else ()))
        limits = [limit for kind in kinds for limit in graph.all(each, kind)]
        limits += ["0"] if NOTHING in graph.all(each, OWL + "allValuesFrom") else []
        for limit in limits:
            if on and limit.isdecimal():
                found[on] = min(int(limit), found.get(on, int(limit)))
    return found


_FUNCTIONAL = OWL + "FunctionalProperty"
_INVERSE_FUNCTIONAL = OWL + "InverseFunctionalProperty"
_SYMMETRIC = OWL + "SymmetricProperty"
_ASYMMETRIC = OWL + "AsymmetricProperty"
_IRREFLEXIVE = OWL + "IrreflexiveProperty"
_TRANSITIVE = OWL + "TransitiveProperty"
_OF_RELATIONS = (_INVERSE_FUNCTIONAL, _SYMMETRIC, _ASYMMETRIC, _IRREFLEXIVE, _TRANSITIVE)
"""Types that only relations have."""


def _property(graph: Graph, iri: str) -> Property:
    return Property(
        iri,
        parents=graph.named(iri, RDFS + "subPropertyOf"),
        domain=graph.unions(iri, RDFS + "domain"),
        range=graph.unions(iri, RDFS + "range"),
        is_functional=_FUNCTIONAL in graph.all(iri, RDF + "type"),
        comment=graph.comment(iri),
    )


def _relation(graph: Graph, iri: str) -> ObjectProperty:
    types = graph.all(iri, RDF + "type")
    return ObjectProperty(
        **vars(_property(graph, iri)),
        inverses=graph.named(iri, OWL + "inverseOf"),
        is_inverse_functional=_INVERSE_FUNCTIONAL in types,
        is_symmetric=_SYMMETRIC in types,
        is_asymmetric=_ASYMMETRIC in types,
        is_irreflexive=_IRREFLEXIVE in types,
        is_transitive=_TRANSITIVE in types,
    )


def _data_property(graph: Graph, iri: str) -> DataProperty:
    listed = [
        list(graph.items(graph.first(node, OWL + "oneOf")))
        for node in graph.all(iri, RDFS + "range")
    ]
    values = frozenset(value for each in listed for value in each)
    unit = min(graph.annotations(iri, _UNIT), default="")
    return DataProperty(**vars(_property(graph, iri)), values=values or None, unit=unit)


def _individuals(graph: Graph) -> Iterator[Individual]:
    """The individuals with a type that is not a part of OWL itself."""
    found: dict[str, set[str]] = defaultdict(set)
    for kind, members in graph.types.items():
        for iri in members:
            if not iri.startswith("_:") and (not kind.startswith(RESERVED) or kind in _INDIVIDUAL):
                found[iri] |= {kind} - _INDIVIDUAL
    for iri, types in found.items():
        yield Individual(iri, frozenset(types), graph.comment(iri))


_INDIVIDUAL = {OWL + "NamedIndividual"}


def _with_both_sides(classes: Mapping[str, OwlClass]) -> dict[str, OwlClass]:
    """Make equivalence and disjointness symmetric, whichever class declares them."""
    same: dict[str, set[str]] = defaultdict(set)
    other: dict[str, set[str]] = defaultdict(set)
    for iri, each in classes.items():
        for target in each.equivalents:
            same[target].add(iri)
        for target in each.disjoint:
            other[target].add(iri)
    found = dict(classes)
    for iri in classes.keys() & {*same, *other}:
        each = classes[iri]
        found[iri] = replace(
            each, equivalents=each.equivalents | same[iri], disjoint=each.disjoint | other[iri]
        )
    return found


def _turned_both_ways(relations: Mapping[str, ObjectProperty]) -> dict[str, ObjectProperty]:
    """Make inverses symmetric; a symmetric relation is its own inverse."""
    turned: dict[str, set[str]] = defaultdict(set)
    for iri, each in relations.items():
        for target in each.inverses:
            turned[target].add(iri)
        if each.is_symmetric:
            turned[iri].add(iri)
    return {
        iri: replace(each, inverses=each.inverses | turned[iri]) for iri, each in relations.items()
    }
