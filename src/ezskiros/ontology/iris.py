"""IRIs of RDF, RDF Schema, OWL, XML Schema and GeoSPARQL, and the parts of an IRI."""

from __future__ import annotations

RDF = "http://www.w3.org/1999/02/22-rdf-syntax-ns#"
RDFS = "http://www.w3.org/2000/01/rdf-schema#"
OWL = "http://www.w3.org/2002/07/owl#"
XSD = "http://www.w3.org/2001/XMLSchema#"
THING = OWL + "Thing"
NOTHING = OWL + "Nothing"
AS_WKT = "http://www.opengis.net/ont/geosparql#asWKT"
"""The geometry of an individual as well-known text."""

RESERVED = (RDF, RDFS, OWL, XSD, "http://www.w3.org/XML/1998/namespace")
"""Namespaces of the language itself, which contain no individuals of the world."""


def split(iri: str) -> tuple[str, str]:
    """The namespace of an IRI, with its `#` or `/`, and the name in it."""
    end = max(iri.rfind("#"), iri.rfind("/")) + 1
    return iri[:end], iri[end:]


def stem(namespace: str) -> str:
    """The SkiROS2 name of a namespace: `http://.../RParts.owl#` is `rparts`."""
    last = namespace.rstrip("#/").rpartition("/")[2]
    bare, dot, _ = last.rpartition(".")
    return (bare if dot else last).lower()
