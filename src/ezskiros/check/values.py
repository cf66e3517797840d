"""Comparison of Python values with the data types of XML Schema."""

from __future__ import annotations

from ezskiros.ontology.iris import XSD
from ezskiros.ontology.model import Union

_NUMBERS = {"float", "double", "decimal"}
WHOLE = {
    "integer",
    "int",
    "long",
    "short",
    "byte",
    "nonNegativeInteger",
    "nonPositiveInteger",
    "positiveInteger",
    "negativeInteger",
    "unsignedInt",
    "unsignedLong",
    "unsignedShort",
    "unsignedByte",
}
_TEXTS = {"string", "normalizedString", "token", "anyURI", "Name", "NCName"}
_KNOWN = {"boolean"} | _NUMBERS | WHOLE | _TEXTS


def spelled_types(union: Union) -> frozenset[str]:
    """The data types of a range, without their namespace; none if one of them is unknown."""
    names = frozenset(iri.removeprefix(XSD) for iri in union)
    return names if names <= _KNOWN else frozenset()


def is_value_of(value: object, names: frozenset[str]) -> bool:
    """Say whether a value is of one of these types. A whole number is a number as well."""
    if isinstance(value, bool):
        return "boolean" in names
    if isinstance(value, int):
        return bool(names & (_NUMBERS | WHOLE))
    return bool(names & (_NUMBERS if isinstance(value, float) else _TEXTS))
