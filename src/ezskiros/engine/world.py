"""The world model: which things there are, and what holds of them.

Facts are triples in a store of pyoxigraph, the ontology says what follows from them: classes from
their subclasses, relations from special cases, inverses and symmetry.
"""

from __future__ import annotations

import itertools
import operator
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import pyoxigraph

from ezskiros.ontology import Ontology
from ezskiros.ontology.iris import RDF, split
from ezskiros.ontology.read import Document
from ezskiros.ontology.statements import (
    AnyOf,
    Comparison,
    Generated,
    HasProperty,
    OfType,
    Relation,
    Specified,
    Statement,
    Value,
)

_TYPE = pyoxigraph.NamedNode(RDF + "type")
_COMPARED: dict[str, Callable[[Value, Value], bool]] = {
    "=": operator.eq,
    "<": operator.lt,
    ">": operator.gt,
    "<=": operator.le,
    ">=": operator.ge,
}
_CONVERTED: dict[str, Callable[[str], Value]] = {
    "boolean": lambda text: text in ("true", "1"),
    **dict.fromkeys(("float", "double", "decimal"), float),
    **dict.fromkeys(("integer", "int", "long", "short"), int),
}

Bound = Mapping[str, str]
"""The things that parameters stand for, as IRIs."""


class World:
    """Things and facts. `load` takes a scene, `save` writes one."""

    def __init__(self, ontology: Ontology) -> None:
        self.ontology = ontology
        self._model = ontology.model
        self._store = pyoxigraph.Store()
        self._numbers = itertools.count(1)
        for iri, individual in self._model.individuals.items():
            for owl_class in individual.types:
                self._add(iri, _TYPE.value, pyoxigraph.NamedNode(owl_class))

    def load(self, scene: Document) -> None:
        """Take what a scene says."""
        self._store.extend(scene.triples)

    def save(self, path: Path) -> None:
        """Write all facts as Turtle. Raises `OSError`."""
        prefixes = dict(self._model.names)
        text = pyoxigraph.serialize(
            (quad.triple for quad in self._store),
            format=pyoxigraph.RdfFormat.TURTLE,
            prefixes=prefixes,
        )
        path.write_bytes(text or b"")

    # --- questions --------------------------------------------------------------------------------

    def things(self, owl_class: str) -> list[str]:
        """All things of a class or one of its subclasses, sorted."""
        found = {
            quad.subject.value
            for quad in self._store.quads_for_pattern(None, _TYPE, None)
            if isinstance(quad.subject, pyoxigraph.NamedNode)
            and isinstance(quad.object, pyoxigraph.NamedNode)
            and self._model.is_a(quad.object.value, owl_class)
        }
        return sorted(found)

    def exists(self, thing: str) -> bool:
        """Whether there is such a thing."""
        return any(self._facts(thing, _TYPE.value))

    def is_a(self, thing: str, owl_class: str) -> bool:
        """Whether a thing is of a class."""
        return any(
            isinstance(each, pyoxigraph.NamedNode) and self._model.is_a(each.value, owl_class)
            for each in self._facts(thing, _TYPE.value)
        )

    def are_related(self, subject: str, relation: str, other: str) -> bool:
        """Whether a relation holds, by itself or because of what else is said."""
        return any(
            self._has(subject, each, other) if is_forward else self._has(other, each, subject)
            for each, is_forward in self._implying(relation)
        )

    def values(self, thing: str, data_property: str) -> list[Value]:
        """The values of a data property."""
        found = []
        for each in self._properties(data_property):
            for term in self._facts(thing, each):
                if isinstance(term, pyoxigraph.Literal):
                    found.append(_value(term))
        return found

    def holds(self, statement: Statement, bound: Bound) -> bool:
        """Whether a condition holds; a relation of something that is unspecified does not."""
        return self._is_so(statement, bound) == statement.is_true

    def _is_so(self, statement: Statement, bound: Bound) -> bool:
        """Whether it holds without its `~`."""
        if isinstance(statement, AnyOf):
            return any(self.holds(part, bound) for part in statement.parts)
        subject = bound.get(statement.subject)
        if subject is None:
            return False
        match statement:
            case Relation(relation=relation, object=other):
                there = bound.get(other)
                return there is not None and self.are_related(subject, relation, there)
            case Comparison(property=iri, operator=sign, value=value):
                return any(_compares(sign, each, value) for each in self.values(subject, iri))
            case HasProperty(property=iri):
                return bool(self.values(subject, iri))
            case OfType(owl_class=owl_class):
                return self.is_a(subject, owl_class)
            case Generated():
                return self.exists(subject)
            case Specified():
                return True

    # --- changes ----------------------------------------------------------------------------------

    def new(self, owl_class: str) -> str:
        """A new thing of a class, called as SkiROS2 does: the class and a number."""
        names = (f"{owl_class}-{number}" for number in self._numbers)
        thing = next(name for name in names if not self.exists(name))
        self._add(thing, _TYPE.value, pyoxigraph.NamedNode(owl_class))
        return thing

    def remove(self, thing: str) -> None:
        """Forget a thing, and all that is said of it."""
        node = pyoxigraph.NamedNode(thing)
        for quad in [
            *self._store.quads_for_pattern(node, None, None),
            *self._store.quads_for_pattern(None, None, node),
        ]:
            self._store.remove(quad)

    def relate(self, subject: str, relation: str, other: str) -> None:
        """Make a relation hold. What it can hold of only once is pushed out."""
        declared = self._model.relations.get(relation)
        if declared is not None and declared.is_functional:
            self._forget(subject, relation, None)
        if declared is not None and declared.is_inverse_functional:
            self._forget(None, relation, other)
        self._add(subject, relation, pyoxigraph.NamedNode(other))

    def unrelate(self, subject: str, relation: str, other: str) -> None:
        """Make a relation not hold, whatever it follows from."""
        for each, is_forward in self._implying(relation):
            ends = (subject, other) if is_forward else (other, subject)
            self._forget(ends[0], each, ends[1])

    def set_value(self, thing: str, data_property: str, value: Value) -> None:
        """Give a data property this value and no other."""
        self.unset(thing, data_property)
        self._add(thing, data_property, pyoxigraph.Literal(value))

    def unset(self, thing: str, data_property: str) -> None:
        """Take all values of a data property away."""
        for each in self._properties(data_property):
            self._forget(thing, each, None)

    # --- the store --------------------------------------------------------------------------------

    def _implying(self, relation: str) -> Iterator[tuple[str, bool]]:
        """The relations from which one follows, and whether from subject to object."""
        for iri, declared in self._model.relations.items():
            above = self._model.properties_above(iri)
            if relation in above:
                yield iri, True
            if any(relation in self._model.properties_above(each) for each in declared.inverses):
                yield iri, False
            if declared.is_symmetric and relation in above:
                yield iri, False
        if relation not in self._model.relations:
            yield relation, True

    def _properties(self, data_property: str) -> Iterator[str]:
        """A data property and its special cases."""
        for iri in self._model.values:
            if data_property in self._model.properties_above(iri):
                yield iri

    def _facts(self, subject: str, predicate: str) -> Iterator[object]:
        node, link = pyoxigraph.NamedNode(subject), pyoxigraph.NamedNode(predicate)
        return (quad.object for quad in self._store.quads_for_pattern(node, link, None))

    def _has(self, subject: str, predicate: str, other: str) -> bool:
        quad = pyoxigraph.Quad(*map(pyoxigraph.NamedNode, (subject, predicate, other)))
        return quad in self._store

    def _add(
        self, subject: str, predicate: str, term: pyoxigraph.NamedNode | pyoxigraph.Literal
    ) -> None:
        node, link = pyoxigraph.NamedNode(subject), pyoxigraph.NamedNode(predicate)
        self._store.add(pyoxigraph.Quad(node, link, term))

    def _forget(self, subject: str | None, predicate: str, other: str | None) -> None:
        ends = [None if each is None else pyoxigraph.NamedNode(each) for each in (subject, other)]
        link = pyoxigraph.NamedNode(predicate)
        for quad in [*self._store.quads_for_pattern(ends[0], link, ends[1])]:
            self._store.remove(quad)

    def spelled(self, iri: str) -> str:
        """`skiros:Location-3`."""
        start, name = split(iri)
        known = {each: short for short, each in self._model.names.items()}
        return f"{known[start]}:{name}" if start in known else iri


def _value(term: pyoxigraph.Literal) -> Value:
    """A literal as a value of Python; as text if its type is not known."""
    kind = split(term.datatype.value)[1]
    try:
        return _CONVERTED.get(kind, str)(term.value)
    except ValueError:
        return term.value


def _compares(sign: str, value: Value, other: Value) -> bool:
    """Whether two values compare so; of values that have no order, only `=` may hold."""
    try:
        return _COMPARED[sign](value, other)
    except TypeError:
        return False
