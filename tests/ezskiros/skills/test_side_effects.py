"""Descriptions go on without what they would do."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from support.skill_files import (
    HEADER,
    TYPO,
    VENDOR,
    WRONG,
    check_folder,
    checked,
    described,
    found,
    skill,
    warned,
)

pytestmark = pytest.mark.usefixtures("hall")


@pytest.mark.parametrize(
    ("line", "place"),
    [
        ("text = open('x').read()", "open('x')"),
        ("with open('x', 'w') as f: f.write('x')", "open('x', 'w')"),
        ("import json; json.load(open('x'))['a'] + 1", "open('x')"),
        ("[open(str(each)) for each in range(3)]", "open(str(each))"),
        ("(lambda: open('x'))()", "open('x')"),
        ("name = input() + '.txt'; print('hello ' + name)", "input()"),
        ("import subprocess as s; s.run(['true']).stdout[0]", "s.run(['true'])"),
        ("import socket; s = socket.socket(); s.connect(('h', 1)); s.send(b'')", "socket.socket()"),
        ("import threading as t; a = t.Thread(); a.start(); a.join()", "a.start()"),
        ("import os; os.makedirs('a/b'); os.listdir('a')", "os.makedirs('a/b')"),
        ("import time; time.sleep(100)", "time.sleep(100)"),
        ("try: open('x')\n        except: pass", "open('x')"),
        ("super().__repr__(); self.__own = 3; open(f'{self.__own}')", "open(f'{self.__own}')"),
    ],
)  # fmt: skip
def test_what_comes_after_a_side_effect_is_checked(line: str, place: str) -> None:
    result = checked(skill(f"{line}\n        {WRONG}"))
    assert ("EZS221", place) == found(result)[0]
    assert [one for one in found(result) if one[0] != "EZS221"] == [TYPO]


def test_only_what_does_something_is_replaced() -> None:
    body = """
    import os.path
    name = os.path.join("a", open("b").name, "c")
    self.pre_conditions += Object.Weight < len(os.path.join("a", "b"))
    """
    (clause,) = described(body).skills[0].pre
    assert clause.statement.value == 3  # type: ignore[union-attr]


def test_functions_that_are_called_go_on_as_well(tmp_path: Path) -> None:
    helpers = """
class Port:
    def __init__(self):
        self.file = open("/dev/ttyUSB0", "wb", buffering=0)

    @property
    def is_ready(self):
        self.file.write(b"?")
        return True


def prepare(skill, individual, place):
    if Port().is_ready:
        skill.pre_conditions += individual.hasAA(place)
"""
    call = "import helpers; helpers.prepare(self, Object, Place)"
    result = check_folder(tmp_path, helpers=helpers, skills=skill(call))
    opened = 'open("/dev/ttyUSB0", "wb", buffering=0)'
    assert found(result) == [("EZS221", opened), ("EZS301", "individual.hasAA")]


def test_accessors_of_libraries_do_nothing(library: Path, tmp_path: Path) -> None:
    (library / "vendor.py").write_text(VENDOR)
    line = f"import vendor; vendor.Sensor().reading + 1; {WRONG}"
    result = check_folder(tmp_path, skills=skill(line))
    assert found(result) == [("EZS221", "vendor.Sensor().reading"), TYPO]


def test_nothing_is_asked_of_what_is_half_done(library: Path, tmp_path: Path) -> None:
    (library / "vendor.py").write_text(VENDOR)
    line = f"import vendor; s = vendor.Sensor(); s.connect(); s.value(); {WRONG}"
    assert found(check_folder(tmp_path, skills=skill(line))) == [("EZS221", "s.connect()"), TYPO]


def test_conditions_that_depend_on_what_was_not_done_are_reported() -> None:
    body = """
    if input("heavy?") == "yes":
        self.pre_conditions += Object.Weight > 3.0
    """
    result = described(body)
    assert found(result) == [("EZS221", 'input("heavy?")'), ("EZS225", 'input("heavy?") == "yes"')]
    titles = [each.title for each in result.diagnostics]
    assert "the conditions of `Skill` depend on the result of `input`" in titles


def test_conditions_in_a_loop_over_what_was_not_done_are_reported() -> None:
    result = described("for line in open('x'):\n    self.pre_conditions += Object.Weight")
    assert found(result) == [("EZS221", "open('x')"), ("EZS225", "open('x')")]


@pytest.mark.parametrize(
    "value",
    ["input()", "float(input())", "[1, 2][input()]", "{'a': 1}[input()]", "f'a {input()}'"],
)
def test_a_value_that_was_not_read_is_reported(value: str) -> None:
    result = described(f"self.pre_conditions += Object.Weight < {value}")
    assert [code for code, _ in found(result)] == ["EZS305", "EZS221"]


def test_a_text_with_the_value_of_a_parameter_is_not_known() -> None:
    body = "self.pre_conditions += Place.ContainerState == f'{Name}s'"
    result = described(body, "Place: skiros.Container, Name: str")
    assert [each.title for each in result.diagnostics if each.code == "EZS305"] == [
        "`ContainerState` is compared with a string that is unknown before the skill runs"
    ]


def test_the_name_of_a_choice_is_not_known() -> None:
    text = f"""from enum import Enum
{HEADER}
class Size(Enum):
    SMALL = 1

class Skill(SkillDescription):
    def description(self, Place: skiros.Container, Choice: Size):
        self.pre_conditions += Place.ContainerState == Choice.name
"""
    assert found(checked(text)) == [("EZS305", "Place.ContainerState == Choice.name")]


def test_functions_that_cannot_do_with_a_symbol_give_one() -> None:
    body = """
    import math
    fast = max(math.sqrt(float(Speed)), 3.0)
    self.pre_conditions += Object.hasAA(Place)
    """
    parameters = "Object: skiros.Product, Place: skiros.Container, Speed: float = 1.0"
    assert found(described(body, parameters)) == [TYPO]


@pytest.mark.parametrize(
    "call",
    [
        "math.sqrt(Speed, Speed)",
        "textwrap.dedent(Speed, Speed)",
        "math.hypot(Speed, factor=2)",
        "max(Speed, other=2)",
        "range(Speed)",
        "range(1, 2, 3, Speed)",
    ],
)
def test_a_call_that_is_wrong_with_any_value_is_reported(call: str) -> None:
    body = f"""
    import math, textwrap
    {call}
    """
    assert found(described(body, "Speed: float")) == [("EZS220", call)]


def test_a_function_of_the_user_that_raises_is_reported() -> None:
    text = (
        f"{HEADER}\ndef wanted(speed):\n    open('x')\n    raise ValueError(f'never {{speed}}')\n"
        "class Skill(SkillDescription):\n"
        "    def description(self, Speed: float):\n        wanted(Speed)\n"
    )
    result = checked(text)
    assert [code for code, _ in found(result)] == ["EZS221", "EZS220"]
    assert result.diagnostics[1].primary.text == "never Speed"


def test_a_description_that_ends_python_is_reported() -> None:
    assert [code for code, _ in found(described("import sys; sys.exit(3)"))] == ["EZS220"]


def test_what_is_imported_late_gets_stand_ins(tmp_path: Path) -> None:
    line = f"import rospy; rospy.sleep(3.0); from own import x; {WRONG}"
    result = check_folder(
        tmp_path, skills=skill(line), own="import serial\nx = serial.Serial('a')\n"
    )
    assert found(result) == [TYPO]
    assert sorted(warned(result)) == [("EZS004", "rospy"), ("EZS004", "serial")]
    assert "rospy" not in sys.modules


def test_what_late_imports_do_is_reported_when_all_is_run_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "late_one.py").write_text("import serial, time\ntime.sleep(3)\n")
    monkeypatch.syspath_prepend(tmp_path)
    result = checked(skill(f"import late_one; open('x'); {WRONG}"))
    assert ("EZS004", "serial") in warned(result)
    assert sorted(found(result)) == [("EZS221", "open('x')"), ("EZS221", "time.sleep(3)"), TYPO]


def test_what_stand_ins_give_is_not_known() -> None:
    text = f"""import rospy
{HEADER}
from tf import TransformListener
HEAVY = float(rospy.get_param("heavy", 3.0))
class Skill(SkillDescription):
    def description(self, Object: skiros.Product, Place: skiros.Container):
        place, turn = TransformListener().lookupTransform("a", "b", rospy.Time(0))
        self.pre_conditions += Object.Weight < HEAVY
        if rospy.get_param("x") > 3 and rospy.HIGH > 3:
            self.pre_conditions += Place.contain(Object)
"""
    assert found(checked(text)) == [
        ("EZS305", "Object.Weight < HEAVY"),
        ("EZS225", "rospy.HIGH > 3"),
    ]


def test_types_and_patterns_stay_as_they_are_written() -> None:
    text = f"""from __future__ import annotations
{HEADER}
class Skill(SkillDescription):
    def description(self, Object: skiros.Product, Place: INFERRED[skiros.Container], Mode: int = 1):
        open("x")
        limit: float.nothing = 3.0
        match limit:
            case float() as heavy if heavy > 2.0:
                self.pre_conditions += Object.hasAA(Place)
            case self.pre_conditions | 3: ...
"""
    assert found(checked(text)) == [("EZS221", 'open("x")'), TYPO]
