"""The places where ontology files declare an entity. The texts are searched on demand."""

from __future__ import annotations

import re
from collections.abc import Sequence

from dslkit.source import Span
from ezskiros.ontology.iris import split
from ezskiros.ontology.read import Document


def declaration(documents: Sequence[Document], iri: str) -> Span | None:
    """The first place where a file declares `iri`; None if there is none."""
    for document in documents:
        for spelling in _spellings(document, iri):
            if found := re.search(spelling, document.file.text, re.MULTILINE):
                return Span(document.file, *found.span(1))
    return None


def _spellings(document: Document, iri: str) -> list[str]:
    """Patterns for the spellings of a subject in RDF/XML, Turtle and JSON-LD."""
    namespace, name = split(iri)
    full, short = re.escape(iri), re.escape(name)
    found = [rf'rdf:about="({full})"', rf"^\s*(<{full}>)\s", rf'"@id"\s*:\s*("{full}")']
    if document.base and namespace.rstrip("#/") == document.base.rstrip("#/"):
        found += [rf'rdf:about="(#?{short})"', rf'rdf:ID="({short})"', rf"^\s*(<#?{short}>)\s"]
    prefixes = [prefix for prefix, start in document.prefixes.items() if start == namespace]
    found += [rf"^\s*({re.escape(prefix)}:{short})\s" for prefix in prefixes]
    found += [rf'"@id"\s*:\s*("{re.escape(prefix)}:{short}")' for prefix in prefixes]
    return found


class EntityDeclarations:
    """The declarations of many entities, like `declaration`. Each text is searched once."""

    def __init__(self, documents: Sequence[Document]) -> None:
        self._documents = documents
        self._found = [_all_spelled(each.file.text) for each in documents]

    def place(self, iri: str) -> Span | None:
        """The first place where a file declares `iri`; None if there is none."""
        for document, found in zip(self._documents, self._found, strict=True):
            for spelling in _plain_spellings(document, iri):
                if spelling in found:
                    return Span(document.file, *found[spelling])
        return None


_Spelling = tuple[str, str]
"""A kind of spelling of a subject, and the text."""
_PATTERNS = {
    "about": re.compile(r'rdf:about="([^"]*)"'),
    "ID": re.compile(r'rdf:ID="([^"]*)"'),
    "line": re.compile(r"^[^\S\n]*(\S+)(?=\s)", re.MULTILINE),
    "@id": re.compile(r'"@id"\s*:\s*("[^"]*")'),
}


def _all_spelled(text: str) -> dict[_Spelling, tuple[int, int]]:
    """The first place of each spelling in a text."""
    found: dict[_Spelling, tuple[int, int]] = {}
    for kind, pattern in _PATTERNS.items():
        for each in pattern.finditer(text):
            found.setdefault((kind, each[1]), each.span(1))
    return found


def _plain_spellings(document: Document, iri: str) -> list[_Spelling]:
    """The same spellings as those of `_spellings`, in the same order."""
    namespace, name = split(iri)
    found = [("about", iri), ("line", f"<{iri}>"), ("@id", f'"{iri}"')]
    if document.base and namespace.rstrip("#/") == document.base.rstrip("#/"):
        found += [("about", f"#{name}"), ("about", name), ("ID", name)]
        found += [("line", f"<#{name}>"), ("line", f"<{name}>")]
    prefixes = [prefix for prefix, start in document.prefixes.items() if start == namespace]
    found += [("line", f"{prefix}:{name}") for prefix in prefixes]
    found += [("@id", f'"{prefix}:{name}"') for prefix in prefixes]
    return found
