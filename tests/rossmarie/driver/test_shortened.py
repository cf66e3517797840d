"""However much is wrong with a file, what is said about it can be read."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from dslkit.diagnostics import Severity
from rossmarie import RulesError, load
from rossmarie.cli.main import app
from rossmarie.driver import check_file
from rossmarie.driver.formatting import format_file
from rossmarie.syntax.limits import MAXIMUM_ERRORS

ERRORS = "const name{} = undeclared\n"
WARNINGS = "action unused{};\n"
MISSPELT = "a{};\n"
RULES = """
action stop;
input speed = topic /odom : nav_msgs/Odometry .twist.twist.linear.x timeout 1 sec
rule fast: if speed > 1 m/s then { stop; };
"""


def written(folder: Path, line: str, count: int) -> Path:
    path = folder / "rules.ross"
    path.write_text(RULES + "".join(line.format(number) for number in range(count)))
    return path


def codes(path: Path, severity: Severity) -> list[str]:
    """The codes of the findings that bad, in order."""
    found = check_file(path).diagnostics
    return [finding.code for finding in found if finding.severity is severity]


@pytest.mark.parametrize(
    ("line", "severity", "code", "closing"),
    [
        (ERRORS, Severity.ERROR, "ROSS101", "ROSS022"),
        (MISSPELT, Severity.ERROR, "ROSS005", "ROSS022"),
        (WARNINGS, Severity.WARNING, "ROSS401", "ROSS804"),
    ],
)
def test_of_very_many_findings_the_first_are_shown(
    tmp_path: Path, line: str, severity: Severity, code: str, closing: str
) -> None:
    full = [code] * MAXIMUM_ERRORS
    assert codes(written(tmp_path, line, MAXIMUM_ERRORS), severity) == full
    assert codes(written(tmp_path, line, MAXIMUM_ERRORS + 1), severity) == [*full, closing]
    assert codes(written(tmp_path, line, 5 * MAXIMUM_ERRORS), severity) == [*full, closing]


def test_each_file_has_its_own_count(tmp_path: Path) -> None:
    (tmp_path / "other.ross").write_text("".join(map(ERRORS.format, range(200, 260))))
    path = tmp_path / "rules.ross"
    path.write_text('import "other.ross"\n' + "".join(map(ERRORS.format, range(60))))
    assert codes(path, Severity.ERROR) == ["ROSS101"] * 120


def test_errors_are_shown_behind_very_many_warnings(tmp_path: Path) -> None:
    path = written(tmp_path, WARNINGS, 2 * MAXIMUM_ERRORS)
    path.write_text(path.read_text() + ERRORS.format(0))
    assert codes(path, Severity.ERROR) == ["ROSS101"]


@pytest.mark.parametrize(("line", "exit_code"), [(ERRORS, 1), (MISSPELT, 1), (WARNINGS, 0)])
@pytest.mark.parametrize("form", ["text", "json", "sarif"])
def test_exit_codes_are_the_same_and_every_format_says_that_there_are_more(
    tmp_path: Path, line: str, exit_code: int, form: str
) -> None:
    path = written(tmp_path, line, 3 * MAXIMUM_ERRORS)
    result = CliRunner().invoke(app, ["check", str(path), "--format", form])
    assert result.exit_code == exit_code
    assert f"this file has more than {MAXIMUM_ERRORS} " in result.stdout
    if form == "json":
        counts = json.loads(result.stdout)["summary"]
        assert max(counts["errors"], counts["warnings"]) == MAXIMUM_ERRORS + 1


def test_load_and_fmt_tell_as_many(tmp_path: Path) -> None:
    path = written(tmp_path, MISSPELT, 3 * MAXIMUM_ERRORS)
    with pytest.raises(RulesError) as caught:
        load(path)
    assert len(caught.value.diagnostics) == MAXIMUM_ERRORS + 1
    found = format_file(path)
    assert isinstance(found, tuple)
    assert [finding.code for finding in found][-1] == "ROSS022"
