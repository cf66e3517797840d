"""The conditions of a description, and their representation."""

from __future__ import annotations

import pytest

from ezskiros.ontology.statements import (
    AnyOf,
    Generated,
    HasProperty,
    OfType,
    Relation,
    Specified,
    Statement,
    ValueComparison,
)
from support.skill_files import described, found

SKIROS = "http://rvmi.aau.dk/ontologies/skiros.owl#"
AT, CONTAIN, STATE, WEIGHT = (
    SKIROS + name for name in ("at", "contain", "ContainerState", "Weight")
)


@pytest.mark.parametrize(
    ("expression", "statement"),
    [
        ("Gripper.at(Place)", Relation("Gripper", AT, "Place")),
        ("~Gripper.at(Place)", Relation("Gripper", AT, "Place", is_true=False)),
        ("~ ~Gripper.at(Place)", Relation("Gripper", AT, "Place")),
        ("skiros.at(Gripper, Place)", Relation("Gripper", AT, "Place")),
        ("abstract(Gripper.at(Place))", Relation("Gripper", AT, "Place", is_abstract=True)),
        ('Place.ContainerState == "Empty"', ValueComparison("Place", STATE, "=", "Empty")),
        ('Place.ContainerState != "Empty"', ValueComparison("Place", STATE, "=", "Empty", False)),
        ("Object.Weight < 3.0", ValueComparison("Object", WEIGHT, "<", 3.0)),
        ("Object.Weight >= 3", ValueComparison("Object", WEIGHT, ">=", 3)),
        ("3 >= Object.Weight", ValueComparison("Object", WEIGHT, "<=", 3)),
        ("Object.Weight", HasProperty("Object", WEIGHT)),
        ("~Object.Weight", HasProperty("Object", WEIGHT, is_true=False)),
        ("of_type(Object, skiros.Product)", OfType("Object", SKIROS + "Product")),
        ("specified(Object)", Specified("Object")),
        ("~specified(Object)", Specified("Object", is_true=False)),
        ("generated(Object)", Generated("Object")),
        (
            "Gripper.at(Place) | (Object.Weight < 3) | Object.Weight",
            AnyOf(
                (
                    Relation("Gripper", AT, "Place"),
                    ValueComparison("Object", WEIGHT, "<", 3),
                    HasProperty("Object", WEIGHT),
                )
            ),
        ),
    ],
)
@pytest.mark.parametrize("kind", ["pre", "hold", "post"])
def test_a_condition_says_what_is_written(expression: str, statement: Statement, kind: str) -> None:
    result = described(f"self.{kind}_conditions += {expression}")
    assert found(result) == []
    (skill,) = result.skills
    (clause,) = getattr(skill, kind)
    assert clause.statement == statement
    assert clause.span.text == expression


@pytest.mark.parametrize(
    ("line", "code", "text"),
    [
        ("self.pre_conditions += Gripper.att(Place)", "EZS301", "Gripper.att"),
        ("self.pre_conditions += Gripper.at()", "EZS303", "Gripper.at()"),
        ("self.pre_conditions += Gripper.at(Place, Object)", "EZS303", "Gripper.at(Place, Object)"),
        ("self.pre_conditions += Gripper.at(Speed)", "EZS304", "Gripper.at(Speed)"),
        ("self.pre_conditions += Gripper.at(skiros.Container)", "EZS304",
         "Gripper.at(skiros.Container)"),
        ("self.pre_conditions += Gripper.at('Place')", "EZS304", "Gripper.at('Place')"),
        ("self.pre_conditions += Object.Weight < Speed", "EZS305", "Object.Weight < Speed"),
        ("self.pre_conditions += Object.Weight == None", "EZS305", "Object.Weight == None"),
        ("self.pre_conditions += Gripper.at", "EZS306", "Gripper.at"),
        ("self.pre_conditions += Gripper.at(Place) and Object.Weight", "EZS307",
         "Gripper.at(Place)"),
        ("self.pre_conditions += Gripper.at(Place) or Object.Weight", "EZS307",
         "Gripper.at(Place)"),
        ("self.pre_conditions += 1 < Object.Weight < 3", "EZS307", "1 < Object.Weight < 3"),
        ("if Gripper.at(Place): pass", "EZS307", "Gripper.at(Place)"),
        ("self.pre_conditions += ~of_type(Object, skiros.Product)", "EZS308",
         "~of_type(Object, skiros.Product)"),
        ("self.pre_conditions += Gripper", "EZS309", "Gripper"),
        ("self.pre_conditions += True", "EZS309", "True"),
        ("self.pre_conditions += Gripper.at(Place) | True", "EZS309", "Gripper.at(Place) | True"),
        ("self.pre_conditions += Gripper.at(Place) | Object.Weight < 3", "EZS310",
         "Gripper.at(Place) | Object.Weight < 3"),
        ("self.pre_conditions = Gripper.at(Place)", "EZS209", "self.pre_conditions"),
        ("self.pre_conditions += of_type(Object, 'skiros:Product')", "EZS210",
         "of_type(Object, 'skiros:Product')"),
        ("self.pre_conditions += abstract(Object.Weight)", "EZS211", "abstract(Object.Weight)"),
        ("self.pre_conditions += specified(Speed)", "EZS304", "specified(Speed)"),
        ("self.pre_conditions += Object.Weight(Place)", "EZS311", "Object.Weight(Place)"),
        ("self.pre_conditions += Speed.at(Place)", "EZS312", "Speed.at"),
        ("Object.Weight = 3", "EZS314", "Object.Weight"),
        ("self.pre_conditions.append(Object.Weight)", "EZS215", "self.pre_conditions.append"),
    ],
)  # fmt: skip
def test_what_is_no_condition_is_reported(line: str, code: str, text: str) -> None:
    parameters = "Object: skiros.Product, Gripper: rparts.GripperEffector, Place: skiros.Container"
    result = described(line, f"{parameters}, Speed: float = 1.0")
    assert found(result) == [(code, text)]


def test_not_is_reported_once() -> None:
    result = described("self.pre_conditions += not Gripper.at(Place)")
    assert found(result) == [("EZS307", "Gripper.at(Place)")]


def test_all_that_is_wrong_is_reported_at_once() -> None:
    result = described(
        """
        self.pre_conditions += Gripper.att(Place)
        self.pre_conditions += Gripper.at(Plaace)
        """
    )
    assert [code for code, _ in found(result)] == ["EZS301", "EZS213"]


@pytest.mark.parametrize(
    "wrong",
    [
        "Place.contain(Object) and ~Place.contain(Object)",
        "Place.contain(Object) or Object.Weight",
        "~(Object.Weight and Place.contain(Object))",
        "(Object.Weight and ~Place.contain(Object)) | Object.Weight",
        "0.1 < Object.Weight < 0.2",
    ],
)
def test_what_is_left_of_a_query_of_truth_is_no_condition(wrong: str) -> None:
    result = described(
        f"""
        self.pre_conditions += Place.contain(Object)
        self.pre_conditions += {wrong}
        self.pre_conditions += Object.Weight > 3.0
        self.hold_conditions += Gripper.at(Place)
        """
    )
    assert [each.code for each in result.diagnostics] == ["EZS307"]
    assert len(result.skills[0].pre) == 2
