"""The statements of an ontology, as plain data: classes, relations, data properties, individuals.

All names are IRIs. A `Union` is "one of these classes (or data types)"; several unions hold
together. An empty tuple means that there is no statement, not that nothing fits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeAlias

from ezskiros.ontology.iris import NOTHING, THING

Union: TypeAlias = frozenset[str]


@dataclass(frozen=True)
class OwlClass:
    """A class. `parents` are its direct superclasses, `equivalents` its equivalent classes."""

    iri: str
    parents: frozenset[str] = frozenset()
    equivalents: frozenset[str] = frozenset()
    disjoint: frozenset[str] = frozenset()
    only: Mapping[str, tuple[Union, ...]] = field(default_factory=dict)
    """The allowed classes of the values of each property (owl:allValuesFrom)."""
    some: Mapping[str, tuple[Union, ...]] = field(default_factory=dict)
    """The classes of the required values of each property (owl:someValuesFrom)."""
    most: Mapping[str, int] = field(default_factory=dict)
    """The maximum number of values of each property (owl:maxCardinality, owl:cardinality)."""
    comment: str = ""


@dataclass(frozen=True)
class Property:
    """The common part of object properties and data properties."""

    iri: str
    parents: frozenset[str] = frozenset()
    domain: tuple[Union, ...] = ()
    range: tuple[Union, ...] = ()
    is_functional: bool = False
    comment: str = ""


@dataclass(frozen=True)
class ObjectProperty(Property):
    """A relation between two individuals."""

    inverses: frozenset[str] = frozenset()
    is_inverse_functional: bool = False
    is_symmetric: bool = False
    is_asymmetric: bool = False
    is_irreflexive: bool = False
    is_transitive: bool = False


@dataclass(frozen=True)
class DataProperty(Property):
    """A property with values. Its range are data types of XML Schema, or the literals of `values`.

    `unit` is the value of an annotation with the name `unit`; empty without one.
    """

    values: frozenset[str] | None = None
    unit: str = ""


@dataclass(frozen=True)
class Individual:
    """An individual of the ontology."""

    iri: str
    types: frozenset[str] = frozenset()
    comment: str = ""


@dataclass(frozen=True)
class Model:
    """An ontology. `names` are the namespaces: a short name for the beginning of an IRI."""

    classes: Mapping[str, OwlClass]
    relations: Mapping[str, ObjectProperty]
    values: Mapping[str, DataProperty]
    individuals: Mapping[str, Individual]
    names: Mapping[str, str]

    def above(self, iri: str) -> frozenset[str]:
        """A class and all its superclasses, including owl:Thing."""
        if iri not in self._above:
            self._above[iri] = _reached(iri, self._parents) | {THING}
        return self._above[iri]

    def properties_above(self, iri: str) -> frozenset[str]:
        """A property and all its superproperties."""
        return _reached(iri, self._properties_parents)

    def _parents(self, iri: str) -> Iterable[str]:
        found = self.classes.get(iri)
        return found.parents | found.equivalents if found else ()

    def _properties_parents(self, iri: str) -> Iterable[str]:
        found = self.property(iri)
        return found.parents if found else ()

    def only(self, owl_class: str, iri: str) -> tuple[Union, ...]:
        """The statements of a class and its superclasses about the values of a property."""
        if iri not in self._with_only:
            return ()
        known = (self.classes[each] for each in sorted(self.above(owl_class) & self.classes.keys()))
        return tuple(union for each in known for union in each.only.get(iri, ()))

    @cached_property
    def limited(self) -> frozenset[str]:
        """The properties with a limited number of values."""
        found = {iri for each in self.classes.values() for iri in each.most}
        found |= {each.iri for each in self.values.values() if each.is_functional}
        for each in self.relations.values():
            found |= {each.iri} if each.is_functional or each.is_inverse_functional else set()
        return frozenset(found)

    @cached_property
    def _with_only(self) -> frozenset[str]:
        return frozenset(iri for each in self.classes.values() for iri in each.only)

    def most(self, owl_class: str, iri: str) -> int | None:
        """The maximum number of values of a property for individuals of a class; None without a
        limit.
        """
        known = [self.classes[each] for each in self.above(owl_class) if each in self.classes]
        return min((each.most[iri] for each in known if iri in each.most), default=None)

    _known_bounds: dict[tuple[str, bool], tuple[Union, ...]] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )
    _above: dict[str, frozenset[str]] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def is_a(self, iri: str, other: str) -> bool:
        """Say whether every individual of a class is also of the other class."""
        return other in self.above(iri)

    def are_disjoint(self, iri: str, other: str) -> bool:
        """Say whether no individual can be of both classes."""
        if (iri, other) not in self._disjoint:
            here, there = self.above(iri), self.above(other)
            self._disjoint[iri, other] = (
                self._excludes(here, there)
                or self._excludes(there, here)
                or self.is_empty(iri)
                or self.is_empty(other)
            )
        return self._disjoint[iri, other]

    def exclude(self, one: Union, other: Union) -> bool:
        """Say whether no individual can be of one class of each union.

        This is not said of unions whose classes are all empty.
        """
        if (one, other) not in self._excluded:
            self._excluded[one, other] = all(
                self.are_disjoint(iri, another) for iri in one for another in other
            ) and not (all(map(self.is_empty, one)) or all(map(self.is_empty, other)))
        return self._excluded[one, other]

    _excluded: dict[tuple[Union, Union], bool] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )
    _disjoint: dict[tuple[str, str], bool] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def is_empty(self, iri: str) -> bool:
        """Say whether a class is empty: a subclass of disjoint classes or of owl:Nothing."""
        if iri not in self._empty:
            self._empty[iri] = NOTHING in self.above(iri) or self.conflict(iri) is not None
        return self._empty[iri]

    _empty: dict[str, bool] = field(default_factory=dict, init=False, repr=False, compare=False)

    def conflict(self, iri: str) -> tuple[str, str] | None:
        """Two disjoint superclasses of a class, if there are any."""
        above = self.above(iri)
        for each in sorted(above & self.classes.keys()):
            if others := self.classes[each].disjoint & above:
                return each, min(others)
        return None

    @cached_property
    def has_disjoint_classes(self) -> bool:
        """Say whether the ontology has disjoint or empty classes."""
        known = self.classes.values()
        return any(each.disjoint or NOTHING in each.parents for each in known)

    def _excludes(self, classes: frozenset[str], others: frozenset[str]) -> bool:
        known = (self.classes[each] for each in classes if each in self.classes)
        return any(not each.disjoint.isdisjoint(others) for each in known)

    def domain(self, iri: str) -> tuple[Union, ...]:
        """The required classes of a property's subjects: its own domain and the domains of its
        superproperties.
        """
        return self._bounds(iri, is_domain=True)

    def range(self, iri: str) -> tuple[Union, ...]:
        """The required classes of objects, or types of values, of a property."""
        return self._bounds(iri, is_domain=False)

    def _bounds(self, iri: str, *, is_domain: bool) -> tuple[Union, ...]:
        if (iri, is_domain) not in self._known_bounds:
            self._known_bounds[iri, is_domain] = self._found_bounds(iri, is_domain=is_domain)
        return self._known_bounds[iri, is_domain]

    def _found_bounds(self, iri: str, *, is_domain: bool) -> tuple[Union, ...]:
        found: dict[Union, None] = {}
        for each in self._relatives(iri, is_inverse=False):
            found.update(dict.fromkeys(each.domain if is_domain else each.range))
        for each in self._relatives(iri, is_inverse=True):
            found.update(dict.fromkeys(each.range if is_domain else each.domain))
        return tuple(found)

    def _relatives(self, iri: str, *, is_inverse: bool) -> Iterator[Property]:
        """The properties that a property implies; with `is_inverse`, those that it implies with
        exchanged sides.
        """
        above = [self.property(each) for each in sorted(self.properties_above(iri))]
        if not is_inverse:
            yield from (each for each in above if each is not None)
            return
        for each in above:
            if isinstance(each, ObjectProperty):
                yield from (self.relations[i] for i in each.inverses if i in self.relations)

    def property(self, iri: str) -> Property | None:
        """The relation or data property with an IRI."""
        return self.relations.get(iri) or self.values.get(iri)

    def short(self, iri: str) -> str:
        """A short name such as `skiros:Product`; the IRI if its namespace has no name."""
        for name, start in self.names.items():
            if iri.startswith(start) and len(iri) > len(start):
                return f"{name}:{iri[len(start) :]}"
        return iri

    def entities(self) -> Iterable[str]:
        """The IRIs of all declared entities."""
        return {**self.classes, **self.relations, **self.values, **self.individuals}


def _reached(start: str, following: Callable[[str], Iterable[str]]) -> frozenset[str]:
    """`start`, and all IRIs that follow from it."""
    found = {start}
    work = [start]
    while work:
        new = set(following(work.pop())) - found
        found |= new
        work += new
    return frozenset(found)
