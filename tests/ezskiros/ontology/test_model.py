"""The entailments of an ontology that the checks need."""

from __future__ import annotations

import itertools

from hypothesis import example, given
from hypothesis import strategies as st

from ezskiros.ontology import Ontology
from support.ontologies import START, turtle


def union(*names: str) -> frozenset[str]:
    return frozenset(START + name for name in names)


def test_domains_are_unions_and_all_have_to_hold() -> None:
    ontology = turtle(
        ":A a owl:Class . :B a owl:Class . :C a owl:Class .\n"
        ":p a owl:ObjectProperty ; rdfs:domain [ owl:unionOf ( :A :B ) ] , :C ; rdfs:range :B ."
    )
    assert set(ontology.model.domain(START + "p")) == {union("A", "B"), union("C")}
    assert ontology.model.range(START + "p") == (union("B"),)


def test_what_holds_of_a_property_holds_of_those_below_it() -> None:
    ontology = turtle(
        ":A a owl:Class . :B a owl:Class . :p a owl:ObjectProperty ; rdfs:domain :A .\n"
        ":q a owl:ObjectProperty ; rdfs:subPropertyOf :p ; rdfs:range :B ."
    )
    assert ontology.model.domain(START + "q") == (union("A"),)
    assert ontology.model.range(START + "p") == ()


def test_the_domain_of_an_inverse_is_a_range() -> None:
    ontology = turtle(
        ":A a owl:Class . :B a owl:Class . :p a owl:ObjectProperty ; rdfs:domain :A .\n"
        ":q a owl:ObjectProperty ; owl:inverseOf :p ; rdfs:domain :B ."
    )
    assert ontology.model.range(START + "q") == (union("A"),)
    assert ontology.model.range(START + "p") == (union("B"),)


def test_a_symmetric_relation_relates_alike() -> None:
    ontology = turtle(":A a owl:Class . :p a owl:SymmetricProperty ; rdfs:domain :A .")
    assert ontology.model.range(START + "p") == (union("A"),)


def test_disjoint_classes_have_disjoint_subclasses() -> None:
    ontology = turtle(
        ":A a owl:Class . :B a owl:Class ; owl:disjointWith :A . :C a owl:Class .\n"
        ":D a owl:Class ; rdfs:subClassOf :A .\n"
        "[] a owl:AllDisjointClasses ; owl:members ( :B :C ) ."
    )
    model = ontology.model
    assert model.are_disjoint(START + "D", START + "B")
    assert model.are_disjoint(START + "B", START + "D")
    assert model.are_disjoint(START + "C", START + "B")
    assert not model.are_disjoint(START + "D", START + "C")


def test_what_two_classes_are_to_each_other_holds_whichever_says_so() -> None:
    ontology = turtle(
        ":A a owl:Class ; owl:equivalentClass :B ; owl:disjointWith :C .\n"
        ":B a owl:Class . :C a owl:Class ."
    )
    model = ontology.model
    assert model.is_a(START + "A", START + "B")
    assert model.is_a(START + "B", START + "A")
    assert model.classes[START + "C"].disjoint == {START + "A"}


def test_parts_of_an_intersection_are_superclasses() -> None:
    ontology = turtle(
        ":A a owl:Class . :B a owl:Class .\n"
        ":C a owl:Class ; owl:equivalentClass [ owl:intersectionOf ( :A :B ) ] ."
    )
    assert ontology.model.is_a(START + "C", START + "A")
    assert ontology.model.is_a(START + "C", START + "B")


def test_a_restriction_bounds_the_values_of_a_class() -> None:
    ontology = turtle(
        ":A a owl:Class . :p a owl:ObjectProperty . :B a owl:Class ; rdfs:subClassOf\n"
        "[ a owl:Restriction ; owl:onProperty :p ; owl:allValuesFrom :A ] ."
    )
    assert ontology.model.classes[START + "B"].only == {START + "p": (union("A"),)}


def test_a_class_says_how_many_values_there_are() -> None:
    ontology = turtle(
        ":A a owl:Class . :p a owl:ObjectProperty . :q a owl:ObjectProperty .\n"
        ":v a owl:DatatypeProperty . :B a owl:Class ; rdfs:subClassOf\n"
        "[ owl:onProperty :p ; owl:cardinality 2 ] ,\n"
        "[ owl:onProperty :p ; owl:maxCardinality 3 ] ,\n"
        "[ owl:onProperty :q ; owl:allValuesFrom owl:Nothing ] ,\n"
        "[ owl:onProperty :v ; owl:qualifiedCardinality 1 ; owl:onDataRange xsd:float ] .\n"
        ":C a owl:Class ; rdfs:subClassOf :B ,\n"
        "[ owl:onProperty :p ; owl:maxQualifiedCardinality 1 ; owl:onClass :A ] ."
    )
    most = [ontology.model.most(START + "C", START + name) for name in "pqv"]
    assert most == [2, 0, 1]
    assert ontology.model.most(START + "A", START + "p") is None
    assert ontology.model.limited == {START + name for name in "pqv"}


def test_a_class_below_disjoint_ones_is_empty() -> None:
    ontology = turtle(
        ":A a owl:Class . :B a owl:Class ; owl:disjointWith :A . :C a owl:Class ;\n"
        "rdfs:subClassOf :A , :B . :D a owl:Class ; rdfs:subClassOf owl:Nothing ."
    )
    assert [ontology.model.is_empty(START + name) for name in "ABCD"] == [False, False, True, True]
    assert ontology.model.conflict(START + "C") == (START + "A", START + "B")
    assert ontology.model.are_disjoint(START + "A", START + "C")
    assert not ontology.model.exclude(union("A"), union("C"))
    assert ontology.model.exclude(union("A"), union("B", "C"))


def test_kinds_of_relations_are_known() -> None:
    ontology = turtle(
        ":A a owl:Class . :p a owl:AsymmetricProperty .\n"
        ":q a owl:IrreflexiveProperty , owl:TransitiveProperty ."
    )
    p, q = (ontology.model.relations[START + name] for name in "pq")
    assert (p.is_asymmetric, p.is_irreflexive, p.is_transitive) == (True, False, False)
    assert (q.is_asymmetric, q.is_irreflexive, q.is_transitive) == (False, True, True)


NAMES = "ABCDEFGH"
EDGES = st.lists(st.tuples(st.sampled_from(NAMES), st.sampled_from(NAMES)), max_size=16)


def declared(edges: list[tuple[str, str]]) -> Ontology:
    classes = " ".join(f":{name} a owl:Class ." for name in NAMES)
    return turtle(classes + "".join(f":{a} rdfs:subClassOf :{b} ." for a, b in edges))


def entailed(edges: list[tuple[str, str]]) -> set[tuple[str, str]]:
    """Warshall's algorithm, on names."""
    found = {*edges, *((name, name) for name in NAMES)}
    for middle, a, b in itertools.product(NAMES, repeat=3):
        if (a, middle) in found and (middle, b) in found:
            found.add((a, b))
    return found


@given(EDGES)
@example([*zip("ABBDDFF", "EDFCEAC", strict=True)])  # parents whose own orders disagree
def test_python_knows_the_same_subclasses(edges: list[tuple[str, str]]) -> None:
    """Any graph: several parents, and circles, whose classes mean the same."""
    ontology = declared(edges)
    found = entailed(edges)
    for a, b in itertools.product(NAMES, repeat=2):
        assert ontology.model.is_a(START + a, START + b) == ((a, b) in found)
        here, there = ontology.class_of(START + a), ontology.class_of(START + b)
        assert issubclass(here, there) == ((a, b) in found)
        assert (here is there) == ({(a, b), (b, a)} <= found)
