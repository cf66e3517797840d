"""Ontologies as SkiROS2 loads them: they say the same, and SkiROS2 finds its prefixes in them."""

from __future__ import annotations

from pathlib import Path

import pyoxigraph
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dslkit.diagnostics import Diagnostic
from ezskiros.hosts.owl_files import owl_files
from ezskiros.ontology import Ontology, load
from support.ontologies import HALL, PREFIXES, START, loaded, turtle

ONTOLOGY = "http://www.w3.org/2002/07/owl#Ontology"
TYPE = "http://www.w3.org/1999/02/22-rdf-syntax-ns#type"
TEST_OWL = "ezskiros-test.owl"
HEADER = "<http://example.org/test.owl> a owl:Ontology . "


def saved(files: dict[str, str], folder: Path) -> Path:
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def written(ontology: Ontology) -> dict[str, str]:
    files, found = owl_files(ontology)
    assert found == []
    return files


def headers(text: str) -> list[str]:
    """The ontologies that a file declares: SkiROS2 makes its prefix of one of them."""
    triples = pyoxigraph.parse(text, format=pyoxigraph.RdfFormat.RDF_XML)
    return [
        str(getattr(each.subject, "value", ""))
        for each in triples
        if (each.predicate.value, getattr(each.object, "value", "")) == (TYPE, ONTOLOGY)
    ]


def codes(found: list[Diagnostic]) -> list[str]:
    return [each.code for each in found]


def test_the_example_is_the_same_in_its_owl_files(tmp_path: Path) -> None:
    original = load(HALL, relations=False)
    again = load(saved(written(original), tmp_path), relations=False)
    assert again.model == original.model
    assert len(again.documents) == len(original.documents) == 5


def test_no_file_has_the_name_of_one_of_skiros2() -> None:
    assert all(name.startswith("ezskiros-") for name in written(load(HALL, relations=False)))


def test_the_same_ontology_gives_the_same_files(tmp_path: Path) -> None:
    text = PREFIXES + HEADER + ":Crate a owl:Class ; rdfs:subClassOf [ a owl:Restriction ; "
    text += "owl:onProperty :in ; owl:allValuesFrom [ a owl:Class ; owl:unionOf ( :A :B ) ] ] . "
    path = tmp_path / "test.ttl"
    path.write_text(f"{text} :in a owl:ObjectProperty .")
    first = written(load(path, relations=False))
    path.write_text(f"{text} :in a owl:ObjectProperty . ")  # so that it is read again
    assert written(load(path, relations=False)) == first


def test_a_namespace_that_no_file_is_the_ontology_of_gets_a_file() -> None:
    files = written(turtle(":Crate a owl:Class ."))
    assert headers(files[TEST_OWL]) == []
    assert headers(files["ezskiros-test-namespace.owl"]) == ["http://example.org/test.owl"]


def test_of_two_ontologies_in_a_file_none_is_relied_on() -> None:
    files = written(
        turtle(
            f"{HEADER} <http://example.org/other.owl> a owl:Ontology . "
            ":Crate a owl:Class . <http://example.org/other.owl#Box> a owl:Class ."
        )
    )
    assert sorted(files) == [
        "ezskiros-other-namespace.owl",
        "ezskiros-test-namespace.owl",
        TEST_OWL,
    ]


@pytest.mark.parametrize("misleading", [":", "<http://other.org/test>"])
def test_the_iri_of_an_ontology_takes_no_prefix_of_a_namespace(misleading: str) -> None:
    files = written(turtle(f"{misleading} a owl:Ontology . :Crate a owl:Class ."))
    assert headers(files[TEST_OWL]) == []


def test_relations_are_declared_as_skiros2_knows_them() -> None:
    ontology = turtle(f"{HEADER} :near a owl:SymmetricProperty . :in a owl:ObjectProperty .")
    text = written(ontology)[TEST_OWL]
    assert ontology.model.relations.keys() == {START + "near", START + "in"}
    triples = {str(each) for each in pyoxigraph.parse(text, format=pyoxigraph.RdfFormat.RDF_XML)}
    declared = f"<{TYPE}> <http://www.w3.org/2002/07/owl#ObjectProperty>"
    assert {f"<{START}{name}> {declared}" for name in ("near", "in")} <= triples


def test_a_namespace_may_not_have_a_prefix_of_skiros2() -> None:
    ontology, _ = loaded(
        "@prefix o: <http://example.org/skiros.owl#> . "
        "o:Crate a <http://www.w3.org/2002/07/owl#Class> ."
    )
    files, found = owl_files(ontology)
    assert (files, codes(found)) == ({}, ["EZS885"])
    assert "http://rvmi.aau.dk/ontologies/skiros.owl#" in found[0].title


@pytest.mark.parametrize(
    "iri",
    ["http://example.org/hall/Crate", "urn:Crate", "http://a.org/#Crate", "http://a.org/a:b#C"],
)
def test_a_namespace_without_a_prefix_is_reported(iri: str) -> None:
    ontology, _ = loaded(f"<{iri}> a <http://www.w3.org/2002/07/owl#Class> .")
    files, found = owl_files(ontology)
    assert (files, codes(found)) == ({}, ["EZS884"])


def test_files_of_one_name_in_two_folders_are_reported(tmp_path: Path) -> None:
    for folder, kind in (("a", "Crate"), ("b", "Box")):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "test.ttl").write_text(f"{PREFIXES}:{kind} a owl:Class .")
    files, found = owl_files(load(tmp_path, relations=False))
    assert (files, codes(found)) == ({}, ["EZS886"])


@pytest.mark.parametrize(
    "said",
    [
        r':Crate rdfs:comment "\u0007" .',
        r':Crate rdfs:comment "\uFFFE" .',
        r':Crate rdfs:comment "a\rb" .',
        ":Crate <http://example.org/test.owl#> 3 .",
    ],
)
def test_what_xml_cannot_hold_is_reported(said: str) -> None:
    files, found = owl_files(turtle(f"{HEADER} :Crate a owl:Class . {said}"))
    assert codes(found) in (["EZS887"], [])
    if not found:  # then it is the same again
        assert loaded(files[TEST_OWL], ".owl")[0].model.classes.keys() == {START + "Crate"}


COMMENTS = st.text(st.characters(exclude_categories=["Cs"]), max_size=20)


@given(comments=st.lists(COMMENTS, max_size=4))
def test_comments_stay_or_are_refused(comments: list[str]) -> None:
    literals = [str(pyoxigraph.Literal(each)) for each in comments]
    said = " ".join(f":C{n} a owl:Class ; rdfs:comment {text} ." for n, text in enumerate(literals))
    ontology = turtle(f"{HEADER} :Crate a owl:Class . {said}")
    files, found = owl_files(ontology)
    if found:
        assert set(codes(found)) == {"EZS887"}
    else:
        assert loaded(files[TEST_OWL], ".owl")[0].model == ontology.model
