"""Many declarations are found where each is found by itself."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.ontology import load
from ezskiros.ontology.places import EntityDeclarations, declaration
from support.ontologies import PREFIXES

ROOT = Path(__file__).parents[3]
FOLDERS = [
    ROOT / "examples" / "pick_place" / "ontology",
    ROOT / "tests" / "fixtures" / "ezskiros" / "ontology",
]
XML = """<?xml version="1.0"?>
<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" xmlns="http://x.org/x.owl#"
    xmlns:owl="http://www.w3.org/2002/07/owl#" xml:base="http://x.org/x.owl">
  <owl:Class rdf:about="#B"/> <owl:Class rdf:ID="C"/>
  <owl:Class rdf:about="http://x.org/x.owl#A"/><owl:Class rdf:about="http://x.org/x.owl#B"/>
</rdf:RDF>
"""
JSON = """{"@context": {"x": "http://x.org/x.owl#", "owl": "http://www.w3.org/2002/07/owl#"},
 "@graph": [{"@id": "x:A", "@type": "owl:Class"},
  {"@id" : "http://x.org/x.owl#B", "@type": "owl:Class"}]}
"""


def same_places(*paths: Path) -> int:
    ontology = load(*paths)
    documents = ontology.documents
    known = EntityDeclarations(documents)
    found = 0
    for iri in ontology.model.entities():
        alone, together = declaration(documents, iri), known.place(iri)
        assert (alone and (alone.file, alone.start, alone.end)) == (
            together and (together.file, together.start, together.end)
        )
        found += alone is not None
    return found


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.parent.name)
def test_of_the_examples(folder: Path) -> None:
    assert same_places(folder) > 5


@pytest.mark.parametrize(
    ("name", "text", "count"),
    [
        ("x.owl", XML, 3),
        ("x.jsonld", JSON, 2),
        (
            "x.ttl",
            PREFIXES
            + "\n\n  :A a owl:Class .\n:A-B\n a owl:Class .\n<http://x.org/y#Z> a owl:Class .",
            3,
        ),
        (
            "x.ttl",
            f"{PREFIXES}\n:A a owl:Class .\n<http://example.org/test.owl#A> rdfs:comment 'full' .",
            1,
        ),
    ],
)
def test_of_each_format(name: str, text: str, count: int, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text)
    assert same_places(tmp_path / name) == count
