"""`rossmarie test` and `rossmarie coverage`."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from typer.testing import CliRunner

from rossmarie.cli.main import app
from support.testing import INPUTS

RULES = f"{INPUTS}rule fast: if speed > 1 m/s then {{ slow; }};\n"
RIGHT = 'test "right" { at 0 s speed = 2 m/s; expect fast active at 0 s; }\n'
WRONG = 'test "wrong" { at 0 s speed = 0 m/s; expect fast active at 0 s; }\n'


def run(*arguments: object) -> tuple[int, str]:
    result = CliRunner().invoke(app, [str(each) for each in arguments])
    return result.exit_code, result.output


@pytest.fixture
def rules(tmp_path: Path) -> Path:
    path = tmp_path / "fast.ross"
    path.write_text(RULES, encoding="utf-8")
    return path


def add(rules: Path, text: str) -> None:
    rules.write_text(rules.read_text(encoding="utf-8") + text, encoding="utf-8")


@pytest.mark.parametrize(
    ("tests", "code", "last"),
    [
        (RIGHT, 0, "1 test passed, 0 failed; run on the interpreter and in C"),
        (RIGHT + WRONG, 1, "1 test passed, 1 failed; run on the interpreter and in C"),
    ],
)
def test_the_exit_code_says_how_it_went(rules: Path, tests: str, code: int, last: str) -> None:
    add(rules, tests)
    found, printed = run("test", rules)
    assert (found, printed.strip().split("\n")[-1]) == (code, last)


def test_no_tests_are_not_fine(rules: Path) -> None:
    code, printed = run("test", rules)
    assert code == 1
    assert "ROSS763" in printed


def test_rules_with_errors_are_not_tested(rules: Path) -> None:
    add(rules, 'test "a" { at 0 s sped = 1 m/s; expect fast active at 0 s; }')
    code, printed = run("test", rules)
    assert code == 1
    assert "ROSS126" in printed
    assert "passed" not in printed


def test_an_unknown_name_is_a_wrong_call(rules: Path) -> None:
    add(rules, RIGHT)
    code, printed = run("test", rules, "rigth")
    assert code == 2
    assert "no test is called `rigth`; did you mean `right`?" in printed


def test_tests_are_written_beside_the_rules(rules: Path) -> None:
    code, printed = run("test", rules, "--write")
    assert code == 0
    assert "wrote 2 tests to" in printed
    beside = rules.with_name("fast.tests.ross")
    assert 'import "fast.ross";' in beside.read_text(encoding="utf-8")
    assert run("fmt", "--check", beside)[0] == 0
    assert run("test", beside, "--write")[0] == 2


def test_a_changed_threshold_fails_and_shows_as_a_difference(rules: Path) -> None:
    run("test", rules, "--write")
    beside = rules.with_name("fast.tests.ross")
    before = beside.read_text(encoding="utf-8")
    rules.write_text(RULES.replace("1 m/s", "1.5 m/s"), encoding="utf-8")
    assert run("test", rules)[0] == 1
    assert run("test", rules, "--write")[0] == 0
    after = beside.read_text(encoding="utf-8")
    assert "speed = 1.001 m/s" in before
    assert "speed = 1.501 m/s" in after


def test_build_servers_get_their_report(rules: Path, tmp_path: Path) -> None:
    add(rules, RIGHT + WRONG)
    report = tmp_path / "report.xml"
    run("test", rules, "--junit", report)
    suite = ET.parse(report).getroot()
    assert (suite.get("tests"), suite.get("failures")) == ("2", "1")
    assert [case.get("name") for case in suite if len(case)] == ["wrong"]


def test_without_a_compiler_it_says_so(rules: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    add(rules, RIGHT)
    monkeypatch.setenv("CC", "no-such-compiler")
    code, printed = run("test", rules)
    assert code == 0
    assert "ROSS762" in printed
    assert "run on the interpreter only" in printed


def test_recordings(rules: Path, tmp_path: Path) -> None:
    recording = tmp_path / "drive.csv"
    recording.write_text("time,/odom.twist.twist.linear.x\n0,0.5\n0.3,1.5\n0.6,0.2\n", "utf-8")
    code, printed = run("coverage", rules, recording)
    assert code == 0
    assert "MC/DC 2 of 2, boundaries 0 of 3, lost inputs 0 of 1" in printed
    assert "1 m/s in speed > 1 m/s  1 m/s  0.2 m/s  1.5 m/s" in printed
    assert run("coverage", rules, tmp_path / "none.csv")[0] == 2
