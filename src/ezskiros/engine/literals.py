"""Conversion of RDF literals to Python values."""

from __future__ import annotations

from collections.abc import Callable

import pyoxigraph

from ezskiros.ontology.iris import split
from ezskiros.ontology.statements import Value

_CONVERTED: dict[str, Callable[[str], Value]] = {
    "boolean": lambda text: text in ("true", "1"),
    **dict.fromkeys(("float", "double", "decimal"), float),
    **dict.fromkeys(("integer", "int", "long", "short", "nonNegativeInteger"), int),
}


def value_of(term: pyoxigraph.Literal) -> Value:
    """A literal as a Python value; as text if its type is unknown."""
    kind = split(term.datatype.value)[1]
    try:
        return _CONVERTED.get(kind, str)(term.value)
    except ValueError:
        return term.value
