"""Files of ontologies: all forms say the same; what is wrong with one is reported at its place."""

from __future__ import annotations

from pathlib import Path

import pytest

from dslkit.diagnostics import Collector, DeclaredHere
from ezskiros import session
from ezskiros.ontology import load
from support.ontologies import PREFIXES, START, loaded, turtle

RDF_XML = """\
<?xml version="1.0"?>
<rdf:RDF xmlns="http://example.org/test.owl#"
     xml:base="http://example.org/test.owl"
     xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"
     xmlns:owl="http://www.w3.org/2002/07/owl#"
     xmlns:rdfs="http://www.w3.org/2000/01/rdf-schema#">
    <owl:Class rdf:about="#Robot"/>
    <owl:Class rdf:ID="Arm"><rdfs:comment>A part.</rdfs:comment></owl:Class>
    <owl:ObjectProperty rdf:about="http://example.org/test.owl#hasA">
        <rdfs:domain rdf:resource="#Robot"/>
        <rdfs:range rdf:resource="#Arm"/>
    </owl:ObjectProperty>
</rdf:RDF>
"""
BEGINS_LATE = RDF_XML.replace("<rdf:RDF", f"<!-- {'Ä' * 20_000} -->\n<rdf:RDF")
TURTLE = f"""{PREFIXES}
:Robot a owl:Class .
:Arm a owl:Class ; rdfs:comment "A part." .
:hasA a owl:ObjectProperty ; rdfs:domain :Robot ; rdfs:range :Arm .
"""
JSON_LD = """\
{"@context": {"owl": "http://www.w3.org/2002/07/owl#",
              "rdfs": "http://www.w3.org/2000/01/rdf-schema#",
              "t": "http://example.org/test.owl#"},
 "@graph": [
  {"@id": "t:Robot", "@type": "owl:Class"},
  {"@id": "t:Arm", "@type": "owl:Class", "rdfs:comment": "A part."},
  {"@id": "t:hasA", "@type": "owl:ObjectProperty",
   "rdfs:domain": {"@id": "t:Robot"}, "rdfs:range": {"@id": "t:Arm"}}]}
"""


@pytest.mark.parametrize(
    ("text", "suffix"), [(RDF_XML, ".owl"), (TURTLE, ".ttl"), (JSON_LD, ".jsonld")]
)
def test_all_forms_say_the_same(text: str, suffix: str) -> None:
    ontology, wrong = loaded(text, suffix)
    assert wrong == ()
    assert set(ontology.model.classes) == {START + "Robot", START + "Arm"}
    assert ontology.model.domain(START + "hasA") == (frozenset({START + "Robot"}),)
    assert ontology.model.range(START + "hasA") == (frozenset({START + "Arm"}),)
    assert ontology.test.Arm.__doc__ == "A part."


@pytest.mark.parametrize(
    ("text", "suffix", "name", "line"),
    [
        (RDF_XML, ".owl", "Robot", 7),
        (RDF_XML, ".owl", "Arm", 8),
        (RDF_XML, ".owl", "hasA", 9),
        (BEGINS_LATE, ".owl", "Robot", 8),
        (TURTLE, ".ttl", "hasA", 9),
        (JSON_LD, ".jsonld", "hasA", 7),
    ],
)
def test_the_place_of_a_declaration_is_found(text: str, suffix: str, name: str, line: int) -> None:
    ontology, _ = loaded(text, suffix)
    label = ontology.label(START + name, DeclaredHere())
    assert label is not None
    assert label.span.begin.line == line
    assert name in label.span.text


@pytest.mark.parametrize(
    ("text", "suffix", "line"),
    [
        (TURTLE.replace("a owl:Class .", "a owl:Class", 1), ".ttl", 8),
        (RDF_XML.replace("</owl:Class>", "</owl:Clas>"), ".owl", 8),
        (RDF_XML.replace("xmlns:owl", "xmlns:wol"), ".owl", 7),
        (JSON_LD.replace('"@graph": [', '"@graph": '), ".jsonld", 6),
        ("This is no ontology.", ".owl", 1),
    ],
)
def test_a_broken_file_is_reported_at_its_line(text: str, suffix: str, line: int) -> None:
    _, (wrong,) = loaded(text, suffix)
    assert (wrong.code, wrong.primary.span.begin.line) == ("EZS102", line), wrong.title


def test_a_file_of_another_kind_is_refused() -> None:
    _, wrong = loaded("Robot", ".txt")
    assert [each.code for each in wrong] == ["EZS101"]


def test_a_file_that_declares_nothing_is_reported() -> None:
    for text in (PREFIXES + ":a :b :c .", ""):
        _, wrong = loaded(text)
        assert [each.code for each in wrong] == ["EZS103"]


def test_an_import_that_is_not_there_is_reported() -> None:
    text = PREFIXES + "<http://x/a.owl> owl:imports <http://x/robots.owl> . :R a owl:Class ."
    _, wrong = loaded(text)
    assert [(each.code, each.primary.span.text) for each in wrong] == [
        ("EZS104", "http://x/robots.owl")
    ]


def test_imports_in_a_circle_are_no_trouble(tmp_path: Path) -> None:
    for name, other in (("a", "b"), ("b", "a")):
        text = (
            f"<http://x/{name}.owl> a owl:Ontology ; owl:imports <http://x/{other}.owl> .\n"
            f"<http://x/{name}.owl#C> a owl:Class ; rdfs:subClassOf <http://x/{other}.owl#C> .\n"
        )
        (tmp_path / f"{name}.ttl").write_text(PREFIXES + text)
    world = load(tmp_path)
    assert issubclass(world.a.C, world.b.C)
    assert issubclass(world.b.C, world.a.C)


def test_a_folder_is_searched_without_scenes(tmp_path: Path) -> None:
    (tmp_path / "deep").mkdir()
    (tmp_path / "deep" / "test.ttl").write_text(TURTLE)
    (tmp_path / "scene.turtle").write_text("broken")
    assert load(tmp_path).test.Robot


def test_a_path_that_leads_nowhere_is_reported(tmp_path: Path) -> None:
    collector = Collector()
    with session.collecting(collector):
        load(tmp_path / "nowhere")
    (wrong,) = collector.sorted()
    assert wrong.code == "EZS105"
    assert "nowhere" in wrong.title
    assert Path(wrong.primary.span.file.path).samefile(__file__)


def test_a_folder_without_a_file_is_reported(tmp_path: Path) -> None:
    with pytest.raises(session.SkillError, match="no ontology file in"):
        load(tmp_path)


def test_without_a_check_what_is_wrong_is_raised(tmp_path: Path) -> None:
    with pytest.raises(session.SkillError, match=r"nowhere.* cannot be read"):
        load(tmp_path / "nowhere")


def test_a_list_that_runs_in_a_circle_ends() -> None:
    ontology = turtle(
        ":R a owl:Class . :p a owl:ObjectProperty ; rdfs:domain [ owl:unionOf _:l ] .\n"
        "_:l rdf:first :R ; rdf:rest _:l ."
    )
    assert ontology.model.domain(START + "p") == (frozenset({START + "R"}),)


@pytest.mark.parametrize("text", ["", '<?xml version="1.0"?>\n'])
def test_a_file_without_elements_is_no_xml(text: str) -> None:
    _, (wrong,) = loaded(text, ".owl")
    assert (wrong.code, wrong.title) == ("EZS102", "this is not valid RDF/XML: no element found")
