"""Study logs: every check that gets `--study` appends to them, and nothing else is changed."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import pytest

from dslkit import study
from dslkit.diagnostics import Diagnostic, Label, Severity
from dslkit.source import SourceFile, Span
from support.command_line import run
from support.json_schema import faults

ROOT = Path(__file__).parents[2]
SCHEMA = json.loads((ROOT / "docs/study/log.schema.json").read_text(encoding="utf-8"))
WRONG = """\
action slowDown;
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 0.5 sec;
rule too_fast: if secret > 0.5 m/s then { slowDown; };
"""
RIGHT = WRONG.replace("secret", "speed")


def finding(path: Path) -> Diagnostic:
    span = Span(SourceFile(str(path), "let secret = 1;"), 4, 10)
    return Diagnostic("ROSS101", "x", Severity.ERROR, "`secret` is unknown", Label(span, "secret"))


def append(log: Path, file: Path, *found: Diagnostic) -> None:
    study.append(log, tool="rossmarie", command="check", release="0", files=[file], found=found)


def test_a_run_has_codes_places_and_digests_but_no_text(tmp_path: Path) -> None:
    file = tmp_path / "work" / "rules.ross"
    file.parent.mkdir()
    file.write_text("let secret = 1;")
    log = tmp_path / "log.jsonl"
    append(log, file, finding(file))
    (line,) = study.read_log(log)
    assert faults(line, SCHEMA) == []
    assert line["files"] == [
        {"name": "work/rules.ross", "sha256": hashlib.sha256(b"let secret = 1;").hexdigest()}
    ]
    (found,) = line["findings"]
    assert found["file"] == "work/rules.ross"
    assert (found["start"], found["end"]) == (
        {"line": 1, "column": 5},
        {"line": 1, "column": 11},
    )
    assert "secret" not in log.read_text()


def test_no_folder_outside_of_the_log_is_named(tmp_path: Path) -> None:
    (tmp_path / "logs").mkdir()
    log, file = tmp_path / "logs" / "log.jsonl", tmp_path / "private" / "rules.ross"
    append(log, file, finding(file))
    (line,) = study.read_log(log)
    assert line["files"] == [{"name": "rules.ross", "sha256": None}]
    assert "private" not in log.read_text()


def test_only_its_owner_reads_a_new_log(tmp_path: Path) -> None:
    append(tmp_path / "log.jsonl", tmp_path / "rules.ross")
    assert (tmp_path / "log.jsonl").stat().st_mode & 0o077 == 0


@pytest.mark.parametrize(
    ("text", "line", "reason"),
    [
        ("rule x;\n", 1, "this line is not JSON"),
        ("[1]\n", 1, 'this line does not have "format"'),
        ('{"format": "dslkit-study-log", "version": 2}\n', 1, "this line has version 2"),
        ('{"format": "dslkit-study-log", "version": 1}\n', 1, "`time` of this line"),
        ("{}", 1, "its last line is incomplete"),
        ("\n", 1, "this line is not JSON"),
    ],
)
def test_a_file_that_is_no_log_is_refused(
    tmp_path: Path, text: str, line: int, reason: str
) -> None:
    log = tmp_path / "log.jsonl"
    log.write_text(text)
    with pytest.raises(study.StudyLogError) as caught:
        study.try_log(log)
    assert caught.value.line == line
    assert caught.value.reason.startswith(reason)
    assert log.read_text() == text


@pytest.fixture
def rules(tmp_path: Path) -> Path:
    path = tmp_path / "rules.ross"
    path.write_text(WRONG)
    return path


def test_each_check_of_rules_appends_a_line(rules: Path, tmp_path: Path) -> None:
    log = tmp_path / "log.jsonl"
    for text, code in ((WRONG, 1), (RIGHT, 0)):
        rules.write_text(text)
        assert run("rossmarie", "check", rules, "--study", log).returncode == code
    first, second = study.read_log(log)
    assert [each["code"] for each in first["findings"]] == ["ROSS401", "ROSS101"]
    assert second["findings"] == []
    assert faults(first, SCHEMA) == faults(second, SCHEMA) == []


def test_without_the_option_nothing_is_written(rules: Path, tmp_path: Path) -> None:
    run("rossmarie", "check", rules)
    assert [each.name for each in tmp_path.iterdir()] == ["rules.ross"]


def test_a_check_refuses_a_log_before_it_prints_findings(rules: Path) -> None:
    done = run("rossmarie", "check", rules, "--study", rules)
    assert (done.returncode, done.stdout) == (2, "")
    assert "rules.ross:1:1: this line is not JSON" in done.stderr
    assert rules.read_text() == WRONG


def test_a_log_in_no_folder_is_refused(rules: Path, tmp_path: Path) -> None:
    done = run("rossmarie", "check", rules, "--study", tmp_path / "no" / "log")
    assert (done.returncode, done.stdout) == (2, "")
    assert "there is no folder" in done.stderr


def test_checks_of_skills_and_of_both_append_to_the_same_log(tmp_path: Path) -> None:
    log = tmp_path / "log.jsonl"
    examples = ROOT / "examples"
    run("ezskiros", "check", examples / "pick_place/planted", "--study", log)
    run("crosscheck", "check", examples / "whiteboard/whiteboard.ross", "--study", log)
    skills, both = study.read_log(log)
    assert {each["name"] for each in skills["files"]} == {"__init__.py", "pick.py"}
    assert [each["code"] for each in skills["findings"]] == ["EZS401", "EZS301", "EZS411"]
    assert (both["tool"], both["findings"]) == ("crosscheck", [])
    assert faults(skills, SCHEMA) == faults(both, SCHEMA) == []
