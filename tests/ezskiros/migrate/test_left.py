"""Cases that cannot be translated, beyond the examples of the pages."""

from __future__ import annotations

import pytest

from ezskiros.migrate.migrated import Migrated
from ezskiros.migrate.module import migrate_text

PLACE = 'self.addParam("Place", Element("skiros:Location"), ParamTypes.Required)'
AT = 'self.getRelationCond("", "skiros:at", "Robot", "Place", True)'
NEAR = 'self.getRelationCond("", "skiros:near", "Robot", "Place", True)'


def migrated(*lines: str, before: str = "") -> Migrated:
    body = "".join(f"        {line}\n" for line in lines)
    head = "class Go(SkillDescription):\n    def createDescription(self):\n"
    return migrate_text("skills.py", f"{before}{head}{body}")


def codes(*lines: str, before: str = "") -> list[str]:
    return [each.code for each in migrated(*lines, before=before).diagnostics]


def value(text: str) -> str:
    return f'self.addParam("Value", {text}, ParamTypes.Required)'


@pytest.mark.parametrize(
    ("text", "annotation"),
    [
        ("-1", "int"),
        ("+1.0", "float"),
        ("not 1", "bool"),
        ("1 < 2", "bool"),
        ("-True", "int"),
        ("1 / 2", "float"),
        ("7 // 2 * 3", "int"),
        ("7 % 2.0", "float"),
        ("'a' + 'b'", "str"),
        ("f'{1}'", "str"),
        ("math.pi", "float"),
        ("math.radians(90)", "float"),
        ("float('inf')", "float"),
        ("str(3)", "str"),
        ("LIMIT", "float"),
        ("-LIMIT * 2", "float"),
        ("Mode.FAST", "Mode"),
    ],
)
def test_types_of_values(text: str, annotation: str) -> None:
    before = "import math, enum\nLIMIT = 1.5\nclass Mode(enum.Enum):\n    FAST = 1\n"
    found = migrated(value(text), before=before)
    assert f"Value: {annotation} = {text})" in found.text


@pytest.mark.parametrize(
    "text",
    [
        "None", "[]", "{}", "(1, 2)", "dict", "list", "tuple", "object", "b'x'", "LIMIT", "'a' * 2",
        "2 ** -1", "1 | 2", "math.floor(1.5)", "rospy.Duration(1)", "Mode", "Mode.FAST",
        "lambda: 1", "[x for x in ()]", "1 if LIMIT else 2", "numpy.float64",
    ],
)  # fmt: skip
def test_values_without_a_type(text: str) -> None:
    assert codes(value(text), before="LIMIT = 1\nLIMIT = 'other'\n") == ["EZS704"]


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("self.addParam('X', Element(), ParamTypes.Required)", "EZS707"),
        ("self.addParam('X', Element(*a), ParamTypes.Required)", "EZS707"),
        ("self.addParam('X', Element(CLASS), ParamTypes.Required)", "EZS702"),
        ("self.addParam('X', 1, 0)", "EZS705"),
        ("self.addParam('X', 1, Required)", "EZS705"),
        ("self.addParam('X', 1)", "EZS718"),
        ("self.addParam('X', 1, ParamTypes.Required, [], '', 3)", "EZS718"),
        ("self.addParam(*all)", "EZS718"),
        ("self.addParam('X', 1, ParamTypes.Required, description=TEXT)", "EZS702"),
        ("self.addParam('X', Element('a:B'), ParamTypes.Required, OPTIONS)", "EZS708"),
        ("self.addParam('', 1, ParamTypes.Required)", "EZS719"),
        ("self.addParam('X', Element('http://x/y#Z'), ParamTypes.Required)", "EZS713"),
        ("self.addParam('X', Element('my-own:Z'), ParamTypes.Required)", "EZS713"),
        ("self.addParam('X', Element(''), ParamTypes.Required)", "EZS713"),
        ("if True: pass", "EZS710"),
        ("x = 1", "EZS710"),
        ("Place = self.getIsSpecifiedCond('', 'Place', True)", "EZS710"),
        ("self.addPreCondition(known)", "EZS710"),
        ("self.addPreCondition()", "EZS718"),
        ("self.addPreCondition(self.getIsSpecifiedCond('', 'Place', WANTED))", "EZS702"),
        ("self.addPreCondition(self.getIsSpecifiedCond('', 'Place', 1))", "EZS702"),
        (
            "self.addPreCondition(self.getRelationCond('', RELATION, 'Place', 'Place', True))",
            "EZS702",
        ),
        ("self.addPreCondition(self.getPropCond('', 'W', 'Place', '=', [1], True))", "EZS714"),
        ("self.addPreCondition(self.getPropCond('', 'W', 'Place', '=', None, True))", "EZS714"),
        ("either = self.getOrCond(True)", "EZS715"),
    ],
)
def test_statements_that_are_left(line: str, code: str) -> None:
    found = migrated(PLACE, line)
    assert [each.code for each in found.diagnostics] == [code]
    assert found.left == ["Go"]
    (mark,) = [each for each in found.text.splitlines() if code in each]
    assert found.text.splitlines()[found.text.splitlines().index(mark) + 1].strip() == line


def test_all_that_is_wrong_is_said_at_once() -> None:
    found = codes(value("dict"), "x = 1", PLACE, PLACE, "self.addHoldCondition(x)")
    assert found == ["EZS704", "EZS709", "EZS710", "EZS710"]


def test_a_parameter_that_is_left_is_none_that_is_missing() -> None:
    place = PLACE.replace("Element(", "Element(*").replace("Place", "There")
    there = AT.replace("Place", "There")
    assert codes(place, f"self.addPreCondition({there})") == ["EZS707"]


def test_what_comes_after_the_end_is_not_translated() -> None:
    assert codes(PLACE, "return", f"self.addPreCondition({AT})") == ["EZS710"]
    assert codes(PLACE, f"self.addPreCondition({AT})", "return") == []


def test_a_constant_that_a_parameter_hides() -> None:
    limit = 'self.addParam("LIMIT", 1.0, ParamTypes.Required)'
    heavy = 'self.addPreCondition(self.getPropCond("", "W", "Place", ">", LIMIT, True))'
    assert codes(PLACE, limit, heavy, before="LIMIT = 1.5\n") == ["EZS714"]
    assert codes(PLACE, heavy, before="LIMIT = 1.5\n") == []


def test_a_variable_may_change() -> None:
    text = migrated(
        PLACE,
        f"one = {AT}",
        "either = self.getOrCond(True)",
        "either.addCondition(one)",
        f"one = {NEAR}",
        "either.addCondition(one)",
        "self.addPreCondition(one)",
        "self.addPostCondition(either)",
        "either = self.getOrCond(False)",
        "either.addCondition(one)",
        f"either.addCondition({AT})",
        "self.addPostCondition(either)",
    ).text
    assert "self.post_conditions += Robot.at(Place) | Robot.near(Place)\n" in text
    assert "self.pre_conditions += one\n" in text
    assert "self.post_conditions += ~(Robot.near(Place) | Robot.at(Place))\n" in text


def test_an_or_is_not_changed_after_it_is_added() -> None:
    either = [
        "either = self.getOrCond(True)",
        *(f"either.addCondition({each})" for each in (AT, NEAR)),
    ]
    added = "self.addPreCondition(either)"
    assert codes(PLACE, *either, added, f"either.addCondition({AT})") == ["EZS715"]
    assert codes(PLACE, *either, added, *either, added) == []
    assert codes(PLACE, *either, *either, added) == ["EZS715"]


def test_methods_of_another_form_are_left() -> None:
    for head in (
        "@wrapped\n    def createDescription(self):",
        "def createDescription(self, *more):",
    ):
        text = f"class Go(SkillDescription):\n    {head}\n        pass\n"
        found = migrate_text("skills.py", text)
        assert [each.code for each in found.diagnostics] == ["EZS710"]
        assert migrate_text("skills.py", found.text).text == found.text


def test_comments_of_a_docstring_stay() -> None:
    text = migrated("# above", '"""What it does."""  # behind', PLACE).text
    assert '        # above\n        # behind\n        """What it does."""\n' in text
