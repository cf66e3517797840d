"""`rossmarie report` from the outside: what it writes, says and refuses."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from rossmarie.cli.main import app

RULES = """action stop;

hazard H1 "somebody is run over";

input on = topic /on : std_msgs/Bool timeout 1 sec;

rule it: if on then { stop; } mitigates H1;
"""


@pytest.fixture
def rules(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    path = tmp_path / "rules.ross"
    path.write_text(RULES)
    return path


def report(*arguments: str) -> Result:
    return CliRunner().invoke(app, ["report", "rules.ross", *arguments])


def verification(rules: Path, **change: object) -> str:
    digest = hashlib.sha256(rules.read_bytes()).hexdigest()
    whole = {
        "format": "rossmarie-verification",
        "version": 1,
        "tools": {"cbmc": "6.6.0"},
        "sources": [{"path": "rules.ross", "sha256": digest}],
        "results": [{"name": "no overflow", "status": "proved"}],
    }
    Path("v.json").write_text(json.dumps({**whole, **change}))
    return "v.json"


CONFLICT = """action on { set /drive.mode to 1; }
action off { set /drive.mode to 0; }
input speed = topic /speed : std_msgs/Float64 in m/s timeout 1 sec;
rule fast: if speed > 1 m/s then { on; };
rule faster: if speed > 2 m/s then { off; };
"""


def test_a_conflict_is_reported_here_and_in_the_page(rules: Path) -> None:
    rules.write_text(CONFLICT)
    assert "ROSS700" in report().output
    assert "ROSS700" in Path("report.html").read_text()


def test_a_report_is_written_and_says_what_is_open(rules: Path) -> None:
    done = report()
    assert done.exit_code == 0
    assert done.output.startswith("wrote report.html\n")
    assert "not done: No verification report was given." in done.output
    text = Path("report.html").read_text()
    assert hashlib.sha256(rules.read_bytes()).hexdigest() in text
    assert "somebody is run over" in text


def test_the_date_is_given_or_that_of_the_source(
    rules: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert report("--date", "2026-03-04").exit_code == 0
    assert "<dd>2026-03-04</dd>" in Path("report.html").read_text()
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "86400")
    assert report().exit_code == 0
    assert "<dd>1970-01-02</dd>" in Path("report.html").read_text()


@pytest.mark.parametrize("day", ["4.3.2026", "20260304", "2026-02-30", ""])
def test_what_is_no_date_is_refused(rules: Path, day: str) -> None:
    done = report("--date", day)
    assert done.exit_code == 2
    assert f"--date needs YYYY-MM-DD, not `{day}`" in done.output
    assert not Path("report.html").exists()


def test_an_epoch_that_is_no_number_is_refused(
    rules: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "soon")
    done = report()
    assert done.exit_code == 2
    assert "SOURCE_DATE_EPOCH is not a time in seconds: `soon`" in done.output


def test_rules_are_not_written_over(rules: Path) -> None:
    done = report("--out", "rules.ross")
    assert done.exit_code == 2
    assert rules.read_text() == RULES


def test_rules_with_errors_have_no_report(rules: Path) -> None:
    rules.write_text("rule it: if nothing then { };")
    done = report()
    assert done.exit_code == 1
    assert "ROSS101" in done.output
    assert not Path("report.html").exists()


def test_a_verification_report_goes_in(rules: Path) -> None:
    done = report("--verification", verification(rules))
    assert done.exit_code == 0
    assert "verification" not in done.output
    assert "6.6.0" in Path("report.html").read_text()


def test_a_report_on_another_text_is_warned_of(rules: Path) -> None:
    given = verification(rules)
    rules.write_text(RULES + "\n")
    done = report("--verification", given)
    assert done.exit_code == 0
    assert "ROSS782" in done.output
    assert "not done: The verification report is not about these rules" in done.output


def test_a_wrong_or_missing_report_is_refused(rules: Path) -> None:
    done = report("--coverage", verification(rules))
    assert done.exit_code == 1
    assert "ROSS781" in done.output
    done = report("--verification", "none.json")
    assert done.exit_code == 2
    assert "ROSS780" in done.output
    assert not Path("report.html").exists()


def test_thorough_queries_are_asked_and_what_shows_an_answer_is_drawn(rules: Path) -> None:
    rules.write_text(CONFLICT)
    done = report("--thorough")
    assert done.exit_code == 0
    assert "thorough queries" not in done.output
    text = Path("report.html").read_text()
    assert "ROSS711" in text  # asked only thoroughly
    assert "All queries were run." in text
    assert "<title>When fast, faster are active</title>" in text


def test_proofs_are_reported_and_are_no_findings(rules: Path) -> None:
    rules.write_text(CONFLICT + "priority fast over faster;\n")
    done = report("--thorough")
    warnings, proofs = Path("report.html").read_text().split("Proofs and open queries", 1)
    assert "ROSS702" in proofs
    assert "ROSS702" not in warnings
    count = done.output.count("warning[")
    assert f"The check has {count} finding" in done.output
