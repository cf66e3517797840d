"""Signatures of descriptions."""

from __future__ import annotations

import pytest

from ezskiros.skills.interface import Parameter
from ezskiros.skills.markers import Option, ParameterKind
from support.skill_files import HEADER, checked, described, found

ANNOTATED = "__import__('typing').Annotated"


def parameter(written: str) -> Parameter:
    result = described("", written)
    assert found(result) == []
    (skill,) = result.skills
    (only,) = skill.parameters
    return only


@pytest.mark.parametrize(
    ("written", "kind", "options"),
    [
        ("P: skiros.Product", ParameterKind.REQUIRED, ()),
        ("P: INFERRED[skiros.Product]", ParameterKind.INFERRED, ()),
        ("P: OPTIONAL[skiros.Product]", ParameterKind.OPTIONAL, ()),
        ("P: LOCK[skiros.Product]", ParameterKind.REQUIRED, (Option.LOCK,)),
        ("P: CONSUME[INFERRED[skiros.Product]]", ParameterKind.INFERRED, (Option.CONSUME,)),
        (
            "P: INFERRED[UNSPECIFY[RESPECT_TYPE[skiros.Product]]]",
            ParameterKind.INFERRED,
            (Option.RESPECT_TYPE, Option.UNSPECIFY),
        ),
        ("P: 'INFERRED[skiros.Product]'", ParameterKind.INFERRED, ()),
        ("P: INFERRED['skiros.Product']", ParameterKind.INFERRED, ()),
        ("P: OUTPUT[skiros.Product]", ParameterKind.OPTIONAL, (Option.OUTPUT,)),
        ("P: OPTIONAL[OUTPUT[skiros.Product]]", ParameterKind.OPTIONAL, (Option.OUTPUT,)),
    ],
)
def test_an_individual_has_a_kind_and_options(
    written: str, kind: ParameterKind, options: tuple[Option, ...]
) -> None:
    only = parameter(written)
    assert (only.kind, only.options, only.default) == (kind, options, None)
    assert only.iri == "http://rvmi.aau.dk/ontologies/skiros.owl#Product"
    assert only.span.text == "P"


@pytest.mark.parametrize(
    ("written", "kind_of", "default"),
    [
        ("P: float = 0.5", float, 0.5),
        ("P: float = 1", float, 1.0),
        ("P: int = 3", int, 3),
        ("P: str = 'x'", str, "x"),
        ("P: bool = False", bool, False),
        ("P: str", str, None),
        ("*, P: int = 3", int, 3),
        ("P: OUTPUT[int]", int, None),
    ],
)
def test_a_value_has_a_type_and_a_default(written: str, kind_of: type, default: object) -> None:
    only = parameter(written)
    assert (only.type, only.default, type(only.default)) == (kind_of, default, type(default))


def test_an_enumeration_is_a_type() -> None:
    text = (
        f"import enum\n{HEADER}\n"
        "class Mode(enum.Enum):\n    FAST = 1\n\n"
        "class Skill(SkillDescription):\n"
        "    def description(self, P: Mode = Mode.FAST):\n        pass\n"
    )
    result = checked(text)
    assert found(result) == []
    assert str(result.skills[0].parameters[0].default) == "Mode.FAST"


def test_types_may_be_texts_for_the_whole_file() -> None:
    text = (
        f"from __future__ import annotations\n{HEADER}\n"
        "class Skill(SkillDescription):\n"
        "    def description(self, P: INFERRED[skiros.Product], Q: float = 1):\n        pass\n"
    )
    result = checked(text)
    assert found(result) == []
    assert [each.name for each in result.skills[0].parameters] == ["P", "Q"]


@pytest.mark.parametrize(
    ("written", "code", "text"),
    [
        ("P", "EZS202", "P"),
        ("P = 3", "EZS202", "P"),
        ("P: 'cora:Robot'", "EZS203", "'cora:Robot'"),
        ("P: 'unknown'", "EZS203", "'unknown'"),
        ("P: list", "EZS204", "list"),
        ("P: dict[str, int]", "EZS204", "dict[str, int]"),
        ("P: object", "EZS204", "object"),
        ("P: 3", "EZS204", "3"),
        ("P: None", "EZS204", "None"),
        ("P: OPTIONAL[list[float]]", "EZS204", "OPTIONAL[list[float]]"),
        ("P: OPTIONAL[dict]", "EZS204", "OPTIONAL[dict]"),
        ("P: OPTIONAL[[2.0, 8.0]]", "EZS204", "OPTIONAL[[2.0, 8.0]]"),
        ("P: OUTPUT[{}]", "EZS204", "OUTPUT[{}]"),
        ("P: INFERRED[cora.Robot, sumo.Agent]", "EZS204", "INFERRED[cora.Robot, sumo.Agent]"),
        ("P: OPTIONAL[None]", "EZS204", "OPTIONAL[None]"),
        ("P: INFERRED['cora:Robot']", "EZS203", "INFERRED['cora:Robot']"),
        ("Robot: float", "EZS217", "Robot"),
        ("Robot: str = 'ur5'", "EZS217", "Robot"),
        ("P: INFERRED", "EZS006", "INFERRED"),
        ("P: INFERRED(cora.Robot)", "EZS006", "INFERRED(cora.Robot)"),
        ("P: 'OPTIONAL(float)'", "EZS006", "'OPTIONAL(float)'"),
        ("P: LOCK[INFERRED()]", "EZS006", "LOCK[INFERRED()]"),
        ("P: CONSUME[INFERRED]", "EZS006", "CONSUME[INFERRED]"),
        ("P: INFERRED[OUTPUT[cora.Robot]]", "EZS009", "INFERRED[OUTPUT[cora.Robot]]"),
        ("P: OUTPUT[LOCK[cora.Robot]]", "EZS009", "OUTPUT[LOCK[cora.Robot]]"),
        ("P: OUTPUT[cora.Robot] = None", "EZS009", "None"),
        ("P: OUTPUT[float] = 0.0", "EZS009", "0.0"),
        (f"P: {ANNOTATED}[float, Key]", "EZS008", f"{ANNOTATED}[float, Key]"),
        (f"P: {ANNOTATED}[float, Key('')]", "EZS008", f"{ANNOTATED}[float, Key('')]"),
        (f"P: {ANNOTATED}[float, Key(3)]", "EZS008", f"{ANNOTATED}[float, Key(3)]"),
        (
            f"P: {ANNOTATED}[float, Key('a'), Key('b')]",
            "EZS008",
            f"{ANNOTATED}[float, Key('a'), Key('b')]",
        ),
        ("P: int = 0.5", "EZS205", "0.5"),
        ("P: int = True", "EZS205", "True"),
        ("P: float = 'x'", "EZS205", "'x'"),
        ("P: str = None", "EZS205", "None"),
        ("*, P: str = 3", "EZS205", "3"),
        ("P: skiros.Product = None", "EZS206", "None"),
        ("P: INFERRED[float] = 1.0", "EZS207", "INFERRED[float]"),
        ("P: LOCK[str]", "EZS207", "LOCK[str]"),
        ("*P: int", "EZS208", "P"),
        ("**P: int", "EZS208", "P"),
        ("P: skiros.Produkt", "EZS111", "skiros.Produkt"),
        ("P: INFERRED[skiros.Produkt]", "EZS111", "skiros.Produkt"),
        ("P: INFERRED[OPTIONAL[skiros.Product]]", "EZS216", "INFERRED[OPTIONAL[skiros.Product]]"),
        ("P: skirso.Product", "EZS003", "skirso"),
    ],
)
def test_what_is_no_parameter_is_reported(written: str, code: str, text: str) -> None:
    assert found(described("", written)) == [(code, text)]


@pytest.mark.parametrize(
    ("written", "help"),
    [
        ("P: INFERRED", "write `INFERRED[...]`"),
        ("P: INFERRED()", "write `INFERRED[...]`"),
        ("P: LOCK[INFERRED(cora.Robot)]", "write `INFERRED[cora.Robot]`"),
        ("P: OPTIONAL(float)", "write `OPTIONAL[float]`"),
        ("P: OPTIONAL(0.5)", "write `OPTIONAL[0.5]`"),
    ],
)
def test_what_a_marker_needs_is_said(written: str, help: str) -> None:
    (only,) = described("", written).diagnostics
    assert only.help == help


def test_the_thesis_says_why_there_are_no_lists() -> None:
    (only,) = described("", "P: OPTIONAL[list[float]]").diagnostics
    assert "(thesis, Paper IV, section 6)" in only.notes[0]


@pytest.mark.parametrize(
    ("written", "key"),
    [
        (f"P: {ANNOTATED}[skiros.Product, Key('the box')]", "the box"),
        (f"P: {ANNOTATED}[INFERRED[skiros.Product], Key('class')]", "class"),
        (f"P: INFERRED[{ANNOTATED}[skiros.Product, Key('object-1')]]", "object-1"),
        (f"P: {ANNOTATED}[OPTIONAL[float], 'in m', Key('Max (m)')] = 1.0", "Max (m)"),
        (f"P: {ANNOTATED}[skiros.Product, 'handled']", "P"),
        ("P: skiros.Product", "P"),
    ],
)
def test_a_parameter_has_a_key(written: str, key: str) -> None:
    only = parameter(written)
    assert (only.name, only.key) == ("P", key)


@pytest.mark.parametrize("first", [f"{ANNOTATED}[str, Key('the box')]", "str"])
def test_two_parameters_with_one_key_are_reported_at_both_places(first: str) -> None:
    key = "P" if first == "str" else "the box"
    (only,) = described("", f"P: {first}, Q: {ANNOTATED}[float, Key({key!r})]").diagnostics
    assert (only.code, only.primary.span.text) == ("EZS007", "Q")
    assert [label.span.text for label in only.labels] == ["P"]


def test_a_key_may_be_the_name_of_another_parameter_with_a_key() -> None:
    written = f"P: {ANNOTATED}[str, Key('Q')], Q: {ANNOTATED}[str, Key('P')]"
    assert not described("", written).diagnostics


def test_texts_of_parameters_are_kept() -> None:
    text = (
        f"{HEADER}\nclass Skill(SkillDescription):\n"
        '    """Does something.\n\n    And more.\n    """\n\n'
        "    def description(self, P: skiros.Product, Q: float = 1.0):\n"
        '        """Says how.\n\n        Args:\n            P: what is\n                handled\n'
        '            Q: in m/s\n        """\n'
    )
    (skill,) = checked(text).skills
    assert skill.doc == "Does something.\n\nAnd more."
    assert [each.doc for each in skill.parameters] == ["what is handled", "in m/s"]


def test_a_text_of_the_method_goes_before_one_of_the_class() -> None:
    text = (
        f"{HEADER}\nclass Skill(SkillDescription):\n"
        '    """Does something.\n\n    Args:\n        P: of the class\n        Q: in m/s\n'
        '    """\n\n'
        "    def description(self, P: skiros.Product, Q: float = 1.0):\n"
        '        """Says how.\n\n        Args:\n            P: of the method\n        """\n'
    )
    (skill,) = checked(text).skills
    assert [each.doc for each in skill.parameters] == ["of the method", "in m/s"]
