"""Conditions that no world satisfies together, and those that some world does."""

from __future__ import annotations

import pytest

from ezskiros.driver import Checked
from support.skill_files import described_in

LAB = """
:Thing a owl:Class . :Box a owl:Class ; rdfs:subClassOf :Thing .
:Tool a owl:Class ; rdfs:subClassOf :Thing ; owl:disjointWith :Box .
:Sealed a owl:Class ; rdfs:subClassOf :Box , [ owl:onProperty :holds ; owl:maxCardinality 0 ] .
:Pair a owl:Class ; rdfs:subClassOf :Thing , [ owl:onProperty :near ; owl:maxCardinality 2 ] .
:Bare a owl:Class ;
    rdfs:subClassOf :Thing , [ owl:onProperty :near ; owl:allValuesFrom owl:Nothing ] .
:Rack a owl:Class ; rdfs:subClassOf :Thing , [ owl:onProperty :near ; owl:allValuesFrom :Tool ] .
:Odd a owl:Class ; rdfs:subClassOf :Tool , :Box .

:at a owl:ObjectProperty , owl:FunctionalProperty .
:placeOf a owl:ObjectProperty ; owl:inverseOf :at .
:near a owl:ObjectProperty .
:holds a owl:ObjectProperty , owl:InverseFunctionalProperty ; rdfs:subPropertyOf :near .
:inside a owl:ObjectProperty ; owl:inverseOf :holds .
:beside a owl:SymmetricProperty ; rdfs:subPropertyOf :near .
:part a owl:TransitiveProperty .
:above a owl:AsymmetricProperty .
:turns a owl:IrreflexiveProperty .
:uses a owl:ObjectProperty ; rdfs:range :Tool .
:fills a owl:ObjectProperty ; rdfs:domain :Thing ; rdfs:range :Box .

:weight a owl:DatatypeProperty , owl:FunctionalProperty ; rdfs:range xsd:float .
:count a owl:DatatypeProperty ; rdfs:range xsd:integer .
:open a owl:DatatypeProperty ; rdfs:range xsd:boolean .
:state a owl:DatatypeProperty ; rdfs:range [ a rdfs:Datatype ; owl:oneOf ( "empty" "full" ) ] .
:colour a owl:DatatypeProperty .
"""
INDIVIDUALS = "A: test.Thing, B: test.Thing, C: test.Thing, Box: test.Box, Tool: test.Tool"


def reported(result: Checked) -> list[tuple[str, str]]:
    """The findings about combined conditions: the codes, and the labelled texts."""
    return [
        (each.code, each.primary.span.text)
        for each in result.diagnostics
        if each.code not in {"EZS402", "EZS420", "EZS421"}
    ]


def lines(conditions: str) -> str:
    """`pre A.at(B); post ~A.at(B)` as the body of a description."""
    parts = (each.strip().partition(" ") for each in conditions.split(";"))
    return "\n".join(f"self.{kind}_conditions += {what}" for kind, _, what in parts)


def checked(conditions: str, parameters: str = INDIVIDUALS, ontology: str = LAB) -> Checked:
    return described_in(ontology, lines(conditions), parameters)


@pytest.mark.parametrize(
    ("conditions", "code"),
    [
        ("pre A.holds(B); pre ~B.inside(A)", "EZS315"),
        ("pre ~B.inside(A); pre A.holds(B)", "EZS315"),
        ("post A.holds(B); post ~A.near(B)", "EZS315"),
        ("pre B.inside(A); pre ~A.near(B)", "EZS315"),
        ("hold A.beside(B); hold ~B.beside(A)", "EZS315"),
        ("pre A.beside(B); hold ~B.near(A)", "EZS315"),
        ("pre A.part(B); pre B.part(C); pre ~A.part(C)", "EZS315"),
        ("pre A.above(B); pre B.above(A)", "EZS316"),
        ("pre A.above(A)", "EZS317"),
        ("pre A.turns(A)", "EZS317"),
        ("pre A.at(B); pre A.at(C)", "EZS412"),
        ("pre A.at(B); hold A.at(C)", "EZS412"),
        ("post A.at(B); post A.at(C)", "EZS412"),
        ("post B.placeOf(A); post A.at(C)", "EZS412"),
        ("post B.placeOf(A); post C.placeOf(A)", "EZS412"),
        ("post A.holds(C); post B.holds(C)", "EZS412"),
        ("post A.holds(C); post C.inside(B)", "EZS412"),
        ("pre of_type(Tool, test.Box)", "EZS319"),
        ("pre A.uses(B); post C.fills(B)", "EZS319"),
        ("pre of_type(A, test.Tool); pre of_type(A, test.Box)", "EZS319"),
        ("pre of_type(Box, test.Sealed); pre Box.holds(A)", "EZS318"),
        ("pre of_type(A, test.Rack); pre A.holds(Box)", "EZS319"),
        ("pre A.weight == 3.0; pre A.weight == 4.0", "EZS320"),
        ("pre A.weight == 3.0; pre A.weight > 5.0", "EZS320"),
        ("pre ~A.colour; pre A.colour == 'red'", "EZS320"),
        ("pre ~A.count; hold A.count < 3", "EZS320"),
        ("pre A.count > 2; pre A.count < 3", "EZS320"),
        ("pre A.count >= 2; pre A.count <= 3; pre A.count != 2; pre A.count != 3", "EZS320"),
        ("pre A.open; pre A.open != True; pre A.open != False", "EZS320"),
        ("pre A.state; pre A.state != 'empty'; pre A.state != 'full'", "EZS320"),
        ("pre A.colour == 'red'; pre A.colour == 'blue'", "EZS321"),
        ("pre A.count == 3; pre A.count > 5", "EZS321"),
        ("hold A.at(B); post ~A.at(B)", "EZS322"),
        ("hold A.at(B); post A.at(C)", "EZS322"),
        ("hold A.holds(B); post C.holds(B)", "EZS322"),
        ("hold A.weight < 3.0; post A.weight > 4.0", "EZS322"),
        ("pre A.at(B); pre A.at(C) | ~A.at(B)", "EZS323"),
        ("pre A.at(B) | A.at(C); pre ~A.at(B); pre ~A.at(C)", "EZS323"),
        ("pre A.at(B) | A.near(B); pre ~A.at(B) | ~C.at(B); pre C.at(B); pre ~A.near(B)", "EZS323"),
        ("pre specified(A); pre ~specified(A) | A.above(A)", "EZS323"),
        ("pre A.at(B); pre ~(A.at(B) | A.near(C))", "EZS411"),
    ],
)  # fmt: skip
def test_what_no_world_satisfies_is_reported(conditions: str, code: str) -> None:
    assert [each for each, _ in reported(checked(conditions))] == [code]


@pytest.mark.parametrize(
    "conditions",
    [
        "pre A.near(B); pre ~A.holds(B)",
        "pre A.holds(B); pre ~A.inside(B)",
        "pre A.holds(B); pre ~B.holds(A)",
        "pre A.part(B); pre B.part(C); pre ~C.part(A)",
        "pre A.above(B); pre B.above(C); pre C.above(A)",
        "pre A.turns(B); pre B.turns(A)",
        "pre A.at(A)",
        "pre A.at(B); post A.at(C)",
        "pre A.at(B); post ~A.at(B)",
        "pre B.placeOf(A); post A.at(C)",
        "pre A.holds(C); post B.holds(C)",
        "pre A.above(B); post B.above(A)",
        "pre A.weight == 3.0; post A.weight == 4.0",
        "post A.holds(B); post A.holds(C)",
        "post A.at(C); post B.at(C)",
        "hold A.at(B); post A.near(C)",
        "pre A.at(B) | A.at(C)",
        "pre A.at(B); pre A.at(C) | A.near(C)",
        "pre A.at(B) | A.at(C); pre ~A.at(B) | ~A.at(C)",
        "pre abstract(A.at(B)); pre abstract(A.at(C))",
        "pre A.above(B); pre ~abstract(A.above(B))",
        "post ~generated(B); post A.at(B); post A.at(C)",
        "pre of_type(A, test.Tool); pre of_type(B, test.Box)",
        "pre of_type(Box, test.Sealed); pre ~Box.holds(A)",
        "pre A.weight > 2.0; pre A.weight < 3.0",
        "pre A.weight == 3.0; pre A.weight != 4.0",
        "pre A.weight == 3.0; pre B.weight == 4.0",
        "pre A.count > 2; pre A.count < 4",
        "pre A.count >= 2; pre A.count <= 3; pre A.count != 2",
        "pre A.count > 2; pre A.count < 10 ** 400",
        "pre ~A.colour; pre A.colour != 'red'",
        "pre A.state != 'empty'; pre A.state != 'full'",
    ],
)
def test_what_some_world_satisfies_is_fine(conditions: str) -> None:
    assert reported(checked(conditions)) == []


def test_what_a_class_has_none_of_is_reported() -> None:
    parameters = "A: test.Thing, Seal: test.Sealed, Bare: test.Bare, Pair: test.Pair, B: test.Box"
    assert reported(checked("pre Seal.holds(A)", parameters)) == [("EZS318", "Seal.holds(A)")]
    assert reported(checked("post Bare.near(A)", parameters)) == [("EZS318", "Bare.near(A)")]
    assert reported(checked("post Pair.near(A); post Pair.near(B)", parameters)) == []
    many = "post Pair.near(A); post Pair.holds(B); post Pair.beside(Seal)"
    assert reported(checked(many, parameters)) == [("EZS412", "Pair.beside(Seal)")]


def test_a_class_that_nothing_can_be_of_is_reported_at_the_parameter() -> None:
    result = checked(
        "pre A.near(Odd); pre of_type(Odd, test.Thing)", "A: test.Thing, Odd: test.Odd"
    )
    assert reported(result) == [("EZS324", "Odd")]
    assert "a test.Box and a test.Tool" in result.diagnostics[0].title


def test_the_other_place_and_the_declarations_are_shown() -> None:
    result = checked("pre A.holds(B); pre ~B.inside(A)")
    found = next(each for each in result.diagnostics if each.code == "EZS315")
    assert found.title == (
        "with the ontology, `A.holds(B)` and `~B.inside(A)` contradict each other before `Skill`"
    )
    assert found.notes == ("test.holds is the inverse of test.inside; so `B.inside(A)` follows",)
    assert [each.span.text for each in found.labels] == ["A.holds(B)", ":holds", ":inside"]


def test_both_ends_of_a_chain_are_shown() -> None:
    result = checked("pre A.part(B); pre B.part(C); pre ~A.part(C)")
    found = next(each for each in result.diagnostics if each.code == "EZS315")
    assert [each.span.text for each in found.labels] == ["A.part(B)", "B.part(C)", ":part"]
    assert found.notes == ("test.part is transitive; so `A.part(C)` follows",)


def test_the_parameter_is_shown_whose_class_says_so() -> None:
    result = checked("pre of_type(Tool, test.Box)")
    found = next(each for each in result.diagnostics if each.code == "EZS319")
    assert (
        found.title
        == "`of_type(Tool, test.Box)` would make an individual a member of disjoint classes"
    )
    assert found.notes == (
        "`Tool` would be a test.Tool and a test.Box, and these classes are disjoint",
    )
    assert [(each.span.text, each.text) for each in found.labels] == [
        ("Tool", "declared as a test.Tool")
    ]


def test_what_excludes_an_alternative_is_shown() -> None:
    result = checked("pre ~A.at(B); pre ~A.near(C); pre A.at(B) | A.holds(C)")
    found = next(each for each in result.diagnostics if each.code == "EZS323")
    assert [(each.span.text, each.text) for each in found.labels] == [
        ("~A.at(B)", "excludes `A.at(B)`"),
        ("~A.near(C)", "excludes `A.holds(C)`"),
    ]
    assert found.notes == ("test.holds is a special case of test.near; so `A.near(C)` follows",)


def test_one_mistake_is_reported_once() -> None:
    conditions = "pre A.holds(B); hold ~B.inside(A); post A.holds(B); pre ~A.holds(B)"
    assert [code for code, _ in reported(checked(conditions))] == ["EZS315", "EZS411"]


def test_what_relations_ask_of_a_parameter_is_reported_once() -> None:
    assert reported(checked("pre A.fills(Tool)")) == [("EZS401", "Tool")]
    rack = "Rack: test.Rack, Box: test.Box"
    assert reported(checked("pre Rack.near(Box)", rack)) == [("EZS401", "Box")]


def test_the_same_mistake_before_and_after_is_reported_twice() -> None:
    both = "{0} A.at(B); {0} ~A.at(B)"
    result = checked(f"{both.format('hold')}; {both.format('post')}")
    assert [code for code, _ in reported(result)] == ["EZS411", "EZS411"]


def test_what_does_not_fit_is_no_reason_for_more() -> None:
    assert reported(checked("pre A.near(Box); pre A.fills(Tool); pre B.uses(Tool)")) == [
        ("EZS401", "Tool")
    ]


def test_so_many_alternatives_are_not_combined() -> None:
    parts = " | ".join(f"(A.count == {number})" for number in range(9))
    assert reported(checked(f"pre {parts}; pre {parts.replace('A', 'B')}; pre C.at(A)")) == []
