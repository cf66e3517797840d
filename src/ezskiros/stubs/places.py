"""The namespace and name of each entity of an ontology in a stub."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ezskiros.ontology import Ontology
from ezskiros.ontology.iris import split
from ezskiros.ontology.python_names import identifiers
from ezskiros.ontology.symbols import OntologyClass, Thing

ELSEWHERE = "_elsewhere"
"""The namespace of classes that are used, but not declared."""


def namespaces(ontology: Ontology, known: Iterable[OntologyClass]) -> dict[str, dict[str, str]]:
    """The IRIs by Python name, for each namespace by its Python name.

    Undeclared bases of the classes `known` are in `ELSEWHERE`.
    """
    model = ontology.model
    inside: dict[str, dict[str, str]] = {start: {} for start in model.names.values()}
    other: dict[str, str] = {}
    for iri in model.entities():
        start, name = split(iri)
        if start in inside and name:
            inside[start][name] = iri
    placed = {iri for those in inside.values() for iri in those.values()}
    for iri in sorted(each.iri for each in known if each is not Thing):
        if iri not in placed:
            name = split(iri)[1]
            other[iri if name in other else name] = iri
    found = {
        spelled: _spelled(inside[model.names[name]])
        for spelled, name in identifiers(model.names).items()
    }
    return {**found, **({ELSEWHERE: _spelled(other)} if other else {})}


def _spelled(inside: Mapping[str, str]) -> dict[str, str]:
    return {spelled: inside[name] for spelled, name in sorted(identifiers(inside).items())}


def qualified(namespace: str, name: str) -> str:
    """The stub's name for a class. No name of an ontology hides one that begins with `_`."""
    return f"{alias(namespace)}.{name}"


def alias(namespace: str) -> str:
    """The name of a namespace in the stub itself."""
    return namespace if namespace == ELSEWHERE else f"_{namespace}"
