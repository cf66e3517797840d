"""`rossmarie test` and `rossmarie coverage`."""

from __future__ import annotations

import hashlib
import json
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
    assert "there is no test `rigth`; did you mean `right`?" in printed


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
    assert "MC/DC 2 of 2, boundaries 0 of 3, stale inputs 0 of 1" in printed
    assert "1 m/s in speed > 1 m/s  1 m/s    0.5 m/s  1.5 m/s        0.2 m/s  1.5 m/s" in printed
    assert run("coverage", rules, tmp_path / "none.csv")[0] == 2


DRIVE = "time,/odom.twist.twist.linear.x\n0,0.5\n0.3,1.5\n0.6,0.2\n"


def test_coverage_goes_into_the_safety_file(
    rules: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("drive.csv").write_text(DRIVE, "utf-8")
    code, printed = run("coverage", "fast.ross", "drive.csv", "--out", "c.json")
    assert code == 0
    assert printed.endswith("wrote c.json\n")
    whole = json.loads(Path("c.json").read_text("utf-8"))
    assert whole["bound"] == "1 recording, 0.6 s"
    assert whole["results"][1] == {
        "name": "fast: speed > 1 m/s",
        "status": "not covered",
        "detail": "2/5 seen; not seen: just under 1 m/s, at 1 m/s, just over 1 m/s",
    }
    assert whole["margins"][0] == {
        "name": "1 m/s in speed > 1 m/s",
        "unit": "m/s",
        "value": 1.0,
        "same": [0.5, 1.5],
        "as_often": [0.2, 1.5],
    }
    digest = hashlib.sha256(Path("drive.csv").read_bytes()).hexdigest()
    code, printed = run("report", "fast.ross", "--coverage", "c.json")
    assert code == 0
    assert "not done: The coverage report has 2 not covered" in printed
    assert "ROSS782" not in printed
    page = Path("report.html").read_text("utf-8")
    assert digest in page
    cells = ("1 m/s", "0.5 m/s", "1.5 m/s", "0.2 m/s", "1.5 m/s")
    row = "".join(f"<td>{cell}</td>" for cell in cells)
    assert f'<th scope="row">1 m/s in speed &gt; 1 m/s</th>{row}' in page


def test_a_changed_message_makes_the_coverage_another(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    message = Path("msg/own_msgs/msg/Speed.msg")
    message.parent.mkdir(parents=True)
    message.write_bytes(b"\xef\xbb\xbffloat64 value\n")
    Path("system.ross").write_text('system own { messages "msg"; }\n', "utf-8")
    Path("own.ross").write_text(
        "action stop;\n"
        "input speed = topic /speed : own_msgs/Speed .value in m/s timeout 1 sec;\n"
        "rule fast: if speed > 1 m/s then { stop; };\n",
        "utf-8",
    )
    Path("drive.csv").write_text("time,/speed.value\n0,0.5\n0.3,1.5\n", "utf-8")
    assert run("coverage", "own.ross", "drive.csv", "--out", "c.json")[0] == 0
    whole = json.loads(Path("c.json").read_text("utf-8"))
    names = ["msg/own_msgs/msg/Speed.msg", "system.ross", "own.ross", "drive.csv"]
    assert [each["path"] for each in whole["sources"]] == names
    assert whole["sources"][0]["sha256"] == hashlib.sha256(message.read_bytes()).hexdigest()
    assert "ROSS782" not in run("report", "own.ross", "--coverage", "c.json")[1]
    message.write_text("float64 value # in knots\n", "utf-8")
    code, printed = run("report", "own.ross", "--coverage", "c.json")
    assert code == 0
    assert "`msg/own_msgs/msg/Speed.msg`" in printed


@pytest.mark.parametrize("read", ["fast.ross", "drive.csv"])
def test_what_is_read_is_not_written_over(rules: Path, tmp_path: Path, read: str) -> None:
    drive = tmp_path / "drive.csv"
    drive.write_text(DRIVE, "utf-8")
    code, printed = run("coverage", rules, drive, "--out", tmp_path / read)
    assert code == 2
    assert "choose another --out" in printed
    assert (rules.read_text("utf-8"), drive.read_text("utf-8")) == (RULES, DRIVE)


def test_a_setting_that_no_rule_reads_is_reported(rules: Path) -> None:
    add(
        rules,
        'test "a" { at 0 s speed = 2 m/s, acceleration = [0, 0, 1] m/s^2, ok; '
        "expect fast active at 0 s; }\n",
    )
    code, printed = run("test", rules)
    assert code == 0
    assert "no rule reads the field that the test sets here" in printed
    assert printed.count("ROSS764") == 1
    assert "acceleration = [0, 0, 1] m/s^2" in printed
    assert "of /imu/data the rules read only that it arrives" in printed


def test_of_a_vector_one_number_suffices(rules: Path) -> None:
    add(rules, "rule bump: if acceleration.z > 12 m/s^2 then { slow; };\n")
    add(rules, 'test "a" { at 0 s acceleration = [0, 0, 15] m/s^2; expect bump active at 0 s; }\n')
    assert "ROSS764" not in run("test", rules)[1]
    add(rules, 'test "b" { at 0 s acceleration.x = 1 m/s^2; expect bump inactive at 0 s; }\n')
    assert "ROSS764" in run("test", rules)[1]


@pytest.mark.parametrize(
    ("condition", "setting"),
    [
        ("orientation.pitch() > 5 deg", "orientation.roll = 5 deg"),
        ("any(ranges < 1 m)", "ranges[3] = 2 m"),
        ("ranges[2] < 1 m", "ranges = [1, 2, 3] m"),
    ],
)
def test_parts_of_what_is_read_are_read(rules: Path, condition: str, setting: str) -> None:
    add(rules, f"rule it: if {condition} then {{ slow; }};\n")
    add(rules, f'test "a" {{ at 0 s {setting}; expect it inactive at 0 s; }}\n')
    assert "ROSS764" not in run("test", rules)[1]
