"""Where the files of an ontology declare a thing: looked for in their texts, when it is asked."""

from __future__ import annotations

import re
from collections.abc import Sequence

from dslkit.source import Span
from ezskiros.ontology.iris import split
from ezskiros.ontology.read import Document


def declaration(documents: Sequence[Document], iri: str) -> Span | None:
    """The first place where a file says what `iri` is; None if none is found."""
    for document in documents:
        for spelling in _spellings(document, iri):
            if found := re.search(spelling, document.file.text, re.MULTILINE):
                return Span(document.file, *found.span(1))
    return None


def _spellings(document: Document, iri: str) -> list[str]:
    """Patterns of the ways to write a subject in RDF/XML, Turtle and JSON-LD."""
    namespace, name = split(iri)
    full, short = re.escape(iri), re.escape(name)
    found = [rf'rdf:about="({full})"', rf"^\s*(<{full}>)\s", rf'"@id"\s*:\s*("{full}")']
    if document.base and namespace.rstrip("#/") == document.base.rstrip("#/"):
        found += [rf'rdf:about="(#?{short})"', rf'rdf:ID="({short})"', rf"^\s*(<#?{short}>)\s"]
    prefixes = [prefix for prefix, start in document.prefixes.items() if start == namespace]
    found += [rf"^\s*({re.escape(prefix)}:{short})\s" for prefix in prefixes]
    found += [rf'"@id"\s*:\s*("{re.escape(prefix)}:{short}")' for prefix in prefixes]
    return found
