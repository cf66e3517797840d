"""The text of a scene: the spellings of individuals, and the places of their descriptions."""

from __future__ import annotations

import re

from dslkit.source import SourceFile, Span
from ezskiros.ontology.model import Model
from ezskiros.ontology.read import Document


def spelled_in(document: Document, iri: str, model: Model) -> str:
    """The name of an IRI with the prefixes of a scene, such as `skiros:Location-3`."""
    for prefix, start in document.prefixes.items():
        if start and iri.startswith(start):
            return f"{prefix}:{iri[len(start) :]}"
    return model.short(iri)


def place_in(document: Document, model: Model, individual: str, *parts: str) -> Span:
    """The place where a scene describes an individual, or where another name occurs in its
    description; the beginning of the scene if there is no description.
    """
    spelled = spelled_in(document, individual, model)
    found = _find(document.file, spelled, 0, at_line_start=True)
    for part in parts:
        found = _find(document.file, spelled_in(document, part, model), found.end)
    return found


def _find(file: SourceFile, name: str, start: int, *, at_line_start: bool = False) -> Span:
    """The place of a whole name, from `start` on, otherwise anywhere; the beginning of the file if
    there is none.
    """
    before = r"(?m)^\s*" if at_line_start else r"(?<![\w:-])"
    pattern = re.compile(rf"{before}({re.escape(name)})(?![\w-])")
    found = pattern.search(file.text, start) or pattern.search(file.text)
    return Span(file, *found.span(1)) if found else Span(file, start, start)
