"""Ontologies for tests: texts in, models out."""

from __future__ import annotations

import tempfile
from pathlib import Path

from dslkit.diagnostics import Collector, Diagnostic
from ezskiros import session
from ezskiros.ontology import Ontology, load

HALL = Path(__file__).parents[2] / "examples" / "pick_place" / "ontology"
"""The ontology of the example."""

PREFIXES = """\
@prefix : <http://example.org/test.owl#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
"""
START = "http://example.org/test.owl#"


def loaded(text: str, suffix: str = ".ttl") -> tuple[Ontology, tuple[Diagnostic, ...]]:
    """The ontology of a text, and what is wrong with it."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"test{suffix}"
        path.write_text(text, encoding="utf-8")
        collector = Collector()
        with session.collecting(collector):
            return load(path, relations=False), collector.sorted()


def turtle(text: str) -> Ontology:
    """The ontology of Turtle that is right; names without a prefix are of the namespace `test`."""
    ontology, wrong = loaded(PREFIXES + text)
    assert wrong == (), [each.title for each in wrong]
    return ontology
