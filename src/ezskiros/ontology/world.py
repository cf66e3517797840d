"""Ontologies as Python objects: namespaces with classes, relations and individuals."""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

from dslkit.diagnostics import DeclaredHere, Diagnostic, DidYouMean, Label, Remark, listed
from dslkit.source.named import uses_of
from ezskiros import session
from ezskiros.ontology import condition_errors, errors
from ezskiros.ontology.build import build
from ezskiros.ontology.iris import THING, split
from ezskiros.ontology.model import OwlClass
from ezskiros.ontology.places import declaration
from ezskiros.ontology.python_names import identifier, identifiers
from ezskiros.ontology.read import Document
from ezskiros.ontology.symbols import (
    UNKNOWN,
    OntologyClass,
    RelationOf,
    SameClass,
    Thing,
    UnknownValue,
    ValueOf,
    described,
    ontology_class,
)

_MOST_USES = 3
"""The number of uses of a name that a message shows."""


class Ontology:
    """The declarations of some files. Its attributes are the namespaces: `world.skiros.Product`.

    If a file could not be read, the ontology is incomplete, and an unknown name may be right. Such
    a name is reported only if it is similar to a known one.
    """

    def __init__(self, documents: Sequence[Document], *, is_whole: bool = True) -> None:
        self.documents, self.is_whole = documents, is_whole
        self.model = build(documents)
        self._classes: dict[str, OntologyClass] = {}
        self._others: dict[str, OntologyClass] = {}

    def files(self) -> list[Path]:
        """The user's files of the ontology."""
        paths = (Path(each.file.path) for each in self.documents)
        return [each for each in paths if session.is_of_user(str(each.absolute()))]

    @cached_property
    def namespaces(self) -> dict[str, Namespace]:
        """The namespaces by name."""
        inside: dict[str, dict[str, str]] = {start: {} for start in self.model.names.values()}
        for iri in self.model.entities():
            start, name = split(iri)
            if start in inside and name:
                inside[start][name] = iri
        names = identifiers(self.model.names)
        return {
            spelled: Namespace(self, spelled, inside[self.model.names[name]])
            for spelled, name in names.items()
        }

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        if name in self.namespaces:
            return self.namespaces[name]
        near = difflib.get_close_matches(name, self.namespaces)
        if near or self.is_whole:
            found = errors.UnknownNamespace(spelled=name)
            known = found.Known(known=listed(sorted(self.namespaces)))
            help = DidYouMean(near=near[0]) if near else known
            here = session.here()
            uses = (found.Use().at(each) for each in uses_of(here)[:_MOST_USES])
            session.report(found.at(here, *uses, help=help))
        return UNKNOWN

    @cached_property
    def spelled(self) -> dict[str, str]:
        """The Python names of all declared entities, such as `skiros.Product`, by IRI."""
        return {
            iri: f"{name}.{spelled}"
            for name, namespace in self.namespaces.items()
            for spelled, iri in namespace.__iris__().items()
        }

    def __getitem__(self, name: str) -> Namespace:
        """A namespace, also one with the name of an attribute. Raises `KeyError`."""
        return self.namespaces[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.namespaces]

    @cached_property
    def class_names(self) -> dict[str, str]:
        """The Python name of each class by its bare name: `cora.Robot` by `Robot`."""
        found: dict[str, str] = {}
        for iri in self.model.classes:
            short = self.model.short(iri)
            bare = identifier(split(iri)[1])
            found.setdefault(bare, f"{short.partition(':')[0]}.{bare}")
        return found

    def class_of(self, iri: str) -> OntologyClass:
        """The Python class of an OWL class. Equivalent classes have the same Python class."""
        if iri not in self._classes:
            same = self._meaning(iri)
            first = min(same)
            made = self._made(first)
            self._classes.update(dict.fromkeys(same, made))
        return self._classes[iri]

    def class_as(self, iri: str) -> OntologyClass:
        """The Python class of an OWL class under its own name. Equivalent classes have different
        ones.
        """
        found = self.class_of(iri)
        if found.iri == iri:
            return found
        if iri not in self._others:
            texts = self._texts(iri) | {"__iri__": iri}
            self._others[iri] = SameClass(split(iri)[1], (found,), texts)
        return self._others[iri]

    def _meaning(self, iri: str) -> frozenset[str]:
        """The classes that are equivalent to a class."""
        above = self.model.above(iri) - {THING}
        return frozenset(each for each in above if self.model.is_a(each, iri)) | {iri}

    def _made(self, iri: str) -> OntologyClass:
        above = self.model.above(iri) - self._meaning(iri) - {THING}
        # One order for all classes, with subclasses first: Python looks up names in this order.
        ordered = sorted(above, key=lambda each: (-len(self.model.above(each)), each))
        direct = [
            each
            for each in ordered
            if not any(self.model.is_a(other, each) for other in above - self._meaning(each))
        ]
        order = tuple(dict.fromkeys(map(self.class_of, ordered)))
        bases = _bases(tuple(dict.fromkeys(map(self.class_of, direct))), order)
        texts = self._texts(iri)
        name = split(iri)[1] or str(texts["__qualname__"])
        return ontology_class(name, bases or (Thing,), texts, iri, self)

    def _texts(self, iri: str) -> dict[str, str | None]:
        """The texts of a Python class about its OWL class."""
        name = ".".join(map(identifier, self.model.short(iri).split(":", 1)))
        known = self.model.classes.get(iri, OwlClass(iri))
        return {"__doc__": known.comment or None, "__qualname__": name, "__module__": "ontology"}

    @cached_property
    def properties(self) -> dict[str, list[str]]:
        """Relations and data properties by Python name, in all namespaces."""
        found: dict[str, list[str]] = {}
        for iri in (*self.model.relations, *self.model.values):
            found.setdefault(identifier(split(iri)[1]), []).append(iri)
        return found

    def ambiguous(self) -> frozenset[str]:
        """The Python names of properties that several namespaces have."""
        return frozenset(name for name, iris in self.properties.items() if len(iris) > 1)

    def attribute(self, individual: Thing, name: str) -> Any:
        """The meaning of `individual.name`: a relation, or a data property."""
        candidates = self.properties.get(name, [])
        if len(candidates) > 1:
            candidates = self._fitting(type(individual), candidates) or candidates
        if len(candidates) == 1:
            return self.about(individual, candidates[0], name)
        if candidates:
            session.report(self._ambiguous(individual, name, candidates))
        else:
            self._report_unknown_property(individual, name)
        return UNKNOWN

    def about(self, individual: Thing, iri: str, name: str) -> RelationOf | ValueOf:
        """The property of an individual."""
        if iri in self.model.relations:
            return RelationOf(individual, iri, name)
        return ValueOf(individual, iri, name, session.here())

    def _fitting(self, owl_class: OntologyClass, candidates: list[str]) -> list[str]:
        """The candidates whose domain certainly contains the class."""
        above = self.model.above(owl_class.iri)
        return [
            iri
            for iri in candidates
            if self.model.domain(iri)
            and all(not u.isdisjoint(above) for u in self.model.domain(iri))
        ]

    def _ambiguous(self, individual: Thing, name: str, candidates: list[str]) -> Diagnostic:
        shorts = [self.model.short(iri) for iri in candidates]
        is_relation = candidates[0] in self.model.relations
        example = f"{shorts[0].replace(':', '.')}({individual!r}{', ...' if is_relation else ''})"
        found = condition_errors.AmbiguousProperty(
            spelled=name, properties=listed(shorts), example=example
        )
        return found.at(session.here())

    def _report_unknown_property(self, individual: Thing, name: str) -> None:
        near = difflib.get_close_matches(name, self.properties, n=1, cutoff=0.7)
        if not near and not self.is_whole:
            return
        found = condition_errors.UnknownProperty(
            spelled=name, subject=repr(individual), subject_class=repr(type(individual))
        )
        labels = [self.label(self.properties[near[0]][0], DeclaredHere())] if near else []
        help = DidYouMean(near=near[0]) if near else None
        session.report(found.at(session.here(), *filter(None, labels), help=help))

    def label(self, iri: str, remark: Remark) -> Label | None:
        """A remark at the place where a file declares something."""
        place = declaration(self.documents, iri)
        return remark.at(place) if place else None


def _bases(
    direct: tuple[OntologyClass, ...], order: tuple[OntologyClass, ...]
) -> tuple[OntologyClass, ...]:
    """The base classes that make Python's lookup order equal to this order: the direct
    superclasses, and further ones if necessary.
    """
    if _order(direct) == order:
        return direct
    found = order
    for each in reversed(order):
        fewer = tuple(other for other in found if other is not each)
        if each not in direct and _order(fewer) == order:
            found = fewer
    return found


def _order(bases: tuple[OntologyClass, ...]) -> tuple[type, ...]:
    """The lookup order for some base classes, without Python's own classes and `Thing`; empty if
    there is no consistent order.
    """
    try:
        found = type("Ordered", bases, {}).__mro__[1:] if bases else ()
    except TypeError:
        return ()
    return tuple(each for each in found if isinstance(each, OntologyClass) and each is not Thing)


class Namespace:
    """The entities of one namespace. A name that is not a Python name is accessible as
    `namespace["Large-Box"]`.
    """

    def __init__(self, ontology: Ontology, name: str, inside: dict[str, str]) -> None:
        self.__ontology, self.__name, self.__inside = ontology, name, inside
        self.__spelled = identifiers(inside)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return self[self.__spelled.get(name, name)]

    def __getitem__(self, name: str) -> Any:
        iri = self.__inside.get(name)
        model = self.__ontology.model
        if iri is not None and iri in model.classes:
            return self.__ontology.class_as(iri)
        if iri is not None and model.property(iri) is not None:
            return PropertyOf(self.__ontology, iri, name)
        if iri is not None:
            return model.individuals[iri]
        meant = self._meant(name)
        if meant or self.__ontology.is_whole:
            session.report(self._unknown(name).at(session.here(), help=meant))
        return UNKNOWN

    def _unknown(self, name: str) -> errors.UnknownName:
        return errors.UnknownName(namespace=self.__name, spelled=name)

    def _meant(self, name: str) -> Remark | None:
        """The help with a similar class of this namespace, or of another one."""
        known = {**self.__ontology.class_names, **self._own_classes()}
        if name in known:
            return errors.UnknownName.OtherNamespace(meant=known[name])
        near = difflib.get_close_matches(name, known, n=1)
        return DidYouMean(near=known[near[0]]) if near else None

    def _own_classes(self) -> dict[str, str]:
        """The names with the namespace, by bare Python name."""
        known = self.__ontology.model.classes
        found = (
            spelled for spelled, name in self.__spelled.items() if self.__inside[name] in known
        )
        return {spelled: f"{self.__name}.{spelled}" for spelled in found}

    def __iris__(self) -> dict[str, str]:
        """The IRIs of all declared entities, by Python name."""
        return {spelled: self.__inside[name] for spelled, name in self.__spelled.items()}

    def __dir__(self) -> list[str]:
        return list(self.__spelled)

    def __repr__(self) -> str:
        return f"<namespace {self.__name}>"


class PropertyOf:
    """A relation or data property by itself: `skiros.at(Gripper, StartPose)`."""

    def __init__(self, ontology: Ontology, iri: str, name: str) -> None:
        self._ontology, self._iri, self._name = ontology, iri, name

    @property
    def iri(self) -> str:
        """The IRI of the property."""
        return self._iri

    def __call__(self, subject: object, *objects: object) -> Any:
        """The property of a subject, with objects if it is a relation."""
        if isinstance(subject, UnknownValue):
            return UNKNOWN
        if not isinstance(subject, Thing):
            found = condition_errors.NoIndividual(relation=self._name, found=described(subject))
            session.report(found.at(session.here()))
            return UNKNOWN
        about = self._ontology.about(subject, self._iri, self._name)
        return about(*objects) if isinstance(about, RelationOf) else about

    def __repr__(self) -> str:
        return self._ontology.model.short(self._iri)
