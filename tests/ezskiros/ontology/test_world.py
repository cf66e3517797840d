"""Namespaces as Python objects, and symbols that speak the words of the ontology."""

from __future__ import annotations

import gc
import weakref
from pathlib import Path

import pytest

from dslkit.diagnostics import Collector, Diagnostic
from ezskiros import session
from ezskiros.ontology import Ontology, load
from ezskiros.ontology.statements import HasProperty, Relation
from ezskiros.ontology.symbols import Condition, symbol
from support.ontologies import HALL, START, turtle
from support.parts import ONTOLOGIES, needs
from support.shared import SKIROS2_ONTOLOGIES


@pytest.fixture
def odd() -> Ontology:
    """Names that are no names of Python, and one that is a class, an individual and a relation."""
    return turtle(
        ":class a owl:Class . <http://example.org/test.owl#Large-Box> a owl:Class .\n"
        ":Large_Box a owl:Class . <http://example.org/test.owl#3D> a owl:Class .\n"
        ":Thing a owl:Class , :class ; a owl:ObjectProperty . :mine a :class .\n"
        ":p a owl:ObjectProperty . :v a owl:DatatypeProperty . :import a owl:ObjectProperty ."
    )


def test_names_become_names_of_python(odd: Ontology) -> None:
    test = odd.test
    assert test.class_.iri == START + "class"
    assert test.Large_Box.iri == START + "Large_Box"
    assert test.Large_Box_.iri == test["Large-Box"].iri == START + "Large-Box"
    assert test._3D.iri == START + "3D"
    assert {"class_", "Large_Box_", "_3D"} <= set(dir(test))


def test_a_name_of_several_kinds_is_a_class_first(odd: Ontology) -> None:
    assert odd.test.Thing.iri == START + "Thing"
    individual = symbol(odd.test.Thing, "It")
    assert isinstance(individual.Thing(individual), Condition)
    assert odd.test.mine.types == {START + "class"}


def test_relations_and_values_are_attributes(odd: Ontology) -> None:
    a, b = symbol(odd.test.Thing, "A"), symbol(odd.test.Thing, "B")
    assert a.p(b).statement == Relation("A", START + "p", "B")
    assert (~a.p(b)).statement == Relation("A", START + "p", "B", is_true=False)
    assert a.import_(b).statement == odd.test["import"](a, b).statement
    assert a.v.statement == HasProperty("A", START + "v")
    assert odd.test.v(a).statement == a.v.statement


def findings(ask: str, **names: object) -> list[Diagnostic]:
    collector = Collector()
    with session.collecting(collector):
        eval(ask, names)
    return list(collector.sorted())


@pytest.mark.parametrize(
    ("ask", "code", "help"),
    [
        ("world.skirso", "EZS110", "did you mean `skiros`?"),
        (
            "world.other",
            "EZS110",
            "the namespaces are `cora`, `rparts`, `scalable`, `skiros` and `sumo`",
        ),
        ("world.skiros.Produkt", "EZS111", "did you mean `skiros.Product`?"),
        ("world.skiros.Robot", "EZS111", "another namespace has this name: write `cora.Robot`"),
        ("world.skiros.Robott", "EZS111", "did you mean `cora.Robot`?"),
    ],
)
def test_a_misspelt_name_is_reported(ask: str, code: str, help: str) -> None:
    (found,) = findings(ask, world=load(HALL))
    assert (found.code, found.help) == (code, help)


def test_a_misspelt_relation_is_reported() -> None:
    world = load(HALL)
    (found,) = findings(
        "individual.hasAA(individual)", individual=symbol(world.skiros.Product, "Object")
    )
    assert (found.code, found.help) == ("EZS301", "did you mean `hasA`?")
    assert found.labels[0].span.text == "skiros:hasA"


def test_a_relation_of_several_namespaces_is_distinguished(tmp_path: Path) -> None:
    for name in "ab":
        (tmp_path / f"{name}.ttl").write_text(
            "@prefix owl: <http://www.w3.org/2002/07/owl#> .\n"
            "@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n"
            f"@prefix : <http://x/{name}.owl#> . :C a owl:Class . :D a owl:Class .\n"
            ":p a owl:ObjectProperty ; rdfs:domain :C . :q a owl:ObjectProperty ."
        )
    world = load(tmp_path)
    individual, other = symbol(world.a.C, "It"), symbol(world.a.D, "Other")
    assert individual.p(other).statement.relation == "http://x/a.owl#p"
    (found,) = findings("individual.q(other)", individual=individual, other=other)
    assert (found.code, found.title) == ("EZS302", "`q` is ambiguous: `a:q` and `b:q`")
    assert world.b.q(individual, other).statement.relation == "http://x/b.owl#q"


def test_no_name_of_an_ontology_is_hidden() -> None:
    names = ["iri", "vocabulary", "name", "_name", "m\u00b2"]
    ontology = turtle(
        ":C a owl:Class ." + "".join(f"<{START}{name}> a owl:ObjectProperty ." for name in names)
    )
    individual = symbol(ontology.test.C, "It")
    for name in ("iri", "vocabulary", "name", "_name", "m_"):
        assert isinstance(getattr(individual, name)(individual), Condition)
        assert isinstance(getattr(ontology.test, name)(individual, individual), Condition)


def test_classes_that_mean_the_same_keep_their_names() -> None:
    test = turtle(
        ":B a owl:Class ; owl:equivalentClass :A . :A a owl:Class .\n"
        ":C a owl:Class ; rdfs:subClassOf :B . :D a owl:Class ; rdfs:comment 'the same' ;\n"
        "rdfs:subClassOf :A . :A rdfs:subClassOf :D . :Other a owl:Class ."
    ).test
    same = [test.A, test.B, test.D]
    assert [each.iri for each in same] == [START + "A", START + "B", START + "D"]
    assert [repr(each) for each in same] == ["test.A", "test.B", "test.D"]
    assert (test.B.__doc__, test.D.__doc__) == (None, "the same")
    assert test.B is test.B
    for one in same:
        assert all(issubclass(one, other) for other in same)
        assert issubclass(test.C, one)
        assert not issubclass(one, test.C)
        assert not issubclass(test.Other, one)
        assert all(isinstance(symbol(other, "It"), one) for other in (*same, test.C))
        assert not isinstance(symbol(test.Other, "It"), one)


def test_a_namespace_that_is_no_name_is_made_one(tmp_path: Path) -> None:
    text = "@prefix owl: <http://www.w3.org/2002/07/owl#> . <http://x/my-hall.owl#C> a owl:Class ."
    (tmp_path / "my-hall.ttl").write_text(text)
    assert repr(load(tmp_path).my_hall.C) == "my_hall.C"


def test_a_namespace_may_be_called_like_an_attribute(tmp_path: Path) -> None:
    text = (
        "@prefix owl: <http://www.w3.org/2002/07/owl#> . <http://x/model.owl#classes> a owl:Class ."
    )
    (tmp_path / "model.ttl").write_text(text)
    assert load(tmp_path)["model"].classes.iri == "http://x/model.owl#classes"


def test_the_same_files_are_loaded_once() -> None:
    assert load(HALL) is load(HALL)


def test_what_files_were_long_ago_is_forgotten(tmp_path: Path) -> None:
    """An editor loads a file once more at each change of it."""
    path = tmp_path / "edited.ttl"
    loaded = []
    for version in range(70):
        path.write_text(f"<{START}A> a <http://www.w3.org/2002/07/owl#Class> .{'#' * version}\n")
        loaded.append(weakref.ref(load(path)))
    gc.collect()
    assert [each() is None for each in (loaded[0], loaded[-1])] == [True, False]


def test_what_is_known_of_the_relations_of_skiros_can_be_left_out() -> None:
    contain = "http://rvmi.aau.dk/ontologies/skiros.owl#contain"
    assert load(HALL).model.domain(contain)
    assert load(HALL, relations=False).model.domain(contain) == ()


@needs(ONTOLOGIES)
def test_the_ontologies_of_skiros2_are_known() -> None:
    model = load(SKIROS2_ONTOLOGIES, relations=False).model
    assert (len(model.classes), len(model.relations), len(model.values)) == (93, 44, 69)
    assert sorted(model.names) == ["cora", "corax", "rparts", "skiros", "sumo"]
    world = load(SKIROS2_ONTOLOGIES)
    assert issubclass(world.rparts.GripperEffector, world.sumo.Object)
    assert not issubclass(world.rparts.GripperEffector, world.cora.Robot)
