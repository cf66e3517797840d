"""Descriptions that do more than describe, or never end, or depend on values."""

from __future__ import annotations

from pathlib import Path

import pytest

from ezskiros.skills import tracing
from support.parts import PYTHON_3_11, needs
from support.skill_files import HEADER, checked, described, found, warned

VALUES = "Object: skiros.Product, Place: skiros.Container, Speed: float = 1.0, Fast: bool = True"


@pytest.mark.parametrize(
    ("line", "deed"),
    [
        ("open('x', 'w')", "opens a file"),
        ("import pathlib; pathlib.Path('x').write_text('x')", "opens a file"),
        ("import time; time.sleep(100)", "sleeps"),
        ("import os; os.remove('x')", "changes files or processes"),
        ("import subprocess; subprocess.run(['true'])", "starts a program"),
        ("import socket; socket.create_connection(('localhost', 1))", "uses the network"),
        ("input()", "waits for input"),
        ("import threading; threading.Thread(target=print).start()", "starts a thread"),
        ("try:\n    open('x')\nexcept Exception:\n    pass", "opens a file"),
    ],
)
def test_a_side_effect_is_reported_and_not_done(
    line: str, deed: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    result = described(f"{line}\n")
    assert [(each.code, each.title) for each in result.diagnostics if each.code == "EZS221"] == [
        ("EZS221", f"the description of `Skill` {deed}")
    ]
    assert list(tmp_path.iterdir()) == []


def test_modules_may_be_imported_late() -> None:
    result = described("import wave\nself.post_conditions += Gripper.at(Place)")
    assert found(result) == []


def test_source_may_be_read_for_messages() -> None:
    body = "import linecache, traceback; linecache.clearcache(); traceback.format_stack()"
    assert found(described(body)) == []


def test_what_it_prints_is_dropped(capsys: pytest.CaptureFixture[str]) -> None:
    assert found(described("print('hello')")) == []
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize(
    "line",
    [
        "while True: pass",
        pytest.param(
            "while True:\n    try:\n        x = 1\n    except Exception: pass",
            marks=needs(PYTHON_3_11),  # 3.10 has no ear for timers in a loop that begins with `try`
        ),
        "try:\n    while True: sum(range(10**6))\nexcept: pass\nwhile True: pass",
    ],
)
def test_a_description_that_never_ends_is_reported(
    line: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tracing, "SECONDS", 0.2)
    assert [code for code, _ in found(described(line))] == ["EZS222"]


def test_a_forgotten_self_is_reported() -> None:
    (wrong,) = described("pre_conditions += Place.contain(Object)").diagnostics[:1]
    assert (wrong.code, wrong.help) == ("EZS220", "write `self.pre_conditions += ...`")


@pytest.mark.parametrize(
    ("line", "exception", "text"),
    [
        ("1 / 0", "ZeroDivisionError", "1 / 0"),
        ("self.description(Object, Gripper, Place)", "RecursionError", None),
        ("raise ValueError('why')", "ValueError", "raise ValueError('why')"),
    ],
)
def test_an_exception_is_reported_at_its_place(line: str, exception: str, text: str | None) -> None:
    result = described(line)
    (wrong,) = (each for each in result.diagnostics if each.severity.value == "error")
    assert (wrong.code, wrong.title) == (
        "EZS220",
        f"the description of `Skill` raises {exception}",
    )
    assert text is None or wrong.primary.span.text == text


def test_a_skill_without_a_description_is_reported() -> None:
    result = checked(f"{HEADER}\nclass Skill(SkillDescription):\n    pass\n")
    assert found(result) == [("EZS201", "Skill")]
    assert result.diagnostics[0].labels == ()


@pytest.mark.parametrize(
    ("name", "help"),
    [
        ("descripton", "write `def description(self, Robot: INFERRED[cora.Robot], ...):`"),
        ("Description", "write `def description(self, Robot: INFERRED[cora.Robot], ...):`"),
        ("createDescription", "`ezskiros migrate` translates `createDescription`"),
    ],
)
def test_a_misspelt_description_is_reported(name: str, help: str) -> None:
    text = f"class Skill(SkillDescription):\n    def {name}(self):\n        pass\n"
    (only,) = checked(f"{HEADER}\n{text}").diagnostics
    assert (only.code, only.primary.span.text, only.help) == ("EZS201", "Skill", help)
    (label,) = only.labels
    assert (label.span.text, label.text) == (f"def {name}(self):", "did you mean `description`?")


def test_a_branch_that_says_the_same_is_fine() -> None:
    body = """
    if Speed > 0.5 and Fast:
        self.post_conditions += Place.contain(Object)
    else:
        self.post_conditions += Place.contain(Object)
    """
    assert found(described(body, VALUES)) == []


def test_all_branches_are_looked_into() -> None:
    body = """
    if Speed > 0.5:
        self.post_conditions += Place.containn(Object)
    else:
        self.post_conditions += Place.contian(Object)
    """
    result = described(body, VALUES)
    assert found(result) == [("EZS301", "Place.containn"), ("EZS301", "Place.contian")]


def test_conditions_that_depend_on_a_value_are_reported() -> None:
    body = """
    self.post_conditions += Place.contain(Object)
    if Fast:
        self.pre_conditions += ~Place.contain(Object)
    """
    result = described(body, VALUES)
    assert [code for code, _ in found(result)] == ["EZS223"]
    assert result.diagnostics[-1].title.endswith("depend on the value of `Fast`")


def test_endless_branches_are_cut() -> None:
    assert [code for code, _ in found(described("while Speed > 0: pass", VALUES))] == ["EZS222"]
    result = described("for _ in range(9): bool(Speed > 0)", VALUES)
    assert "EZS224" in dict(warned(result))


def test_helpers_of_the_class_are_run() -> None:
    text = (
        f"{HEADER}\nclass Base(SkillDescription):\n"
        "    def both(self, first, second):\n"
        "        self.pre_conditions += first.contain(second)\n"
        "    def description(self, A: skiros.Container, B: skiros.Product):\n"
        "        self.both(A, B)\n"
    )
    (skill,) = checked(text).skills
    (clause,) = skill.pre
    assert clause.span.text == "first.contain(second)"


def test_a_skill_inherits_its_description() -> None:
    text = (
        f"{HEADER}\nclass Move(SkillDescription):\n"
        "    def description(self, A: skiros.Container, B: skiros.Product):\n"
        "        self.post_conditions += A.contain(B)\n\n"
        "class Carry(Move):\n    pass\n"
    )
    assert [skill.name for skill in checked(text).skills] == ["Move", "Carry"]
