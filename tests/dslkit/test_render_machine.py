"""Findings for programs: JSON as documented, SARIF as its standard asks."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

from hypothesis import given

from dslkit.diagnostics import Diagnostic, Severity
from dslkit.diagnostics.render_json import render_json
from dslkit.diagnostics.render_sarif import SarifRule, Tool, render_sarif
from dslkit.source import SourceFile
from support.findings import any_finding, place, unit_mismatch, warning
from support.golden import assert_golden

GOLDEN = Path(__file__).parent / "golden"

RULES = SourceFile(
    "rules/my arm.ross", "// 名\nconst maximum = 3 N/sec\nrule: if force > maximum\n"
)
FOUND = [unit_mismatch(RULES), warning(place(RULES, "maximum"))]
TOOL = Tool(
    "rossmarie",
    "0.1.0",
    (
        SarifRule("ROSS301", "unit-mismatch", Severity.ERROR, "units do not match", "# ROSS301"),
        SarifRule("ROSS401", "unused", Severity.WARNING, "not used", "# ROSS401"),
        SarifRule("ROSS999", "anything", Severity.WARNING, "anything", "# ROSS999"),
    ),
)


def test_json_is_as_it_was_when_somebody_looked(bless: bool) -> None:
    text = render_json(FOUND, command="rossmarie check", file_count=2)
    assert_golden(GOLDEN / "findings.json", text, bless=bless)


def test_sarif_is_as_it_was_when_somebody_looked(bless: bool) -> None:
    assert_golden(GOLDEN / "findings.sarif", render_sarif(FOUND, TOOL), bless=bless)


@given(any_finding())
def test_json_says_everything_that_a_finding_says(found: Diagnostic) -> None:
    document = json.loads(render_json([found], command="rossmarie check", file_count=1))
    (said,) = document["diagnostics"]
    assert (said["title"], said["help"]) == (found.title, found.help)
    assert tuple(said["notes"]) == found.notes
    places = [said["primary"], *said["labels"], *(said["fix"] or {"edits": []})["edits"]]
    spans = [label.span for label in (found.primary, *found.labels)]
    spans += [edit.span for edit in found.fix.edits] if found.fix else []
    assert [(at["file"], at["start"]["offset"], at["end"]["offset"]) for at in places] == [
        (span.file.path, span.start, span.end) for span in spans
    ]
    counts = document["summary"]
    assert counts["errors"] + counts["warnings"] + counts["notes"] == 1


@given(any_finding())
def test_sarif_has_the_structure_of_its_standard(found: Diagnostic) -> None:
    check_sarif(json.loads(render_sarif([found], TOOL)))


def test_sarif_of_nothing_is_a_run_without_results() -> None:
    log = json.loads(render_sarif([], TOOL))
    check_sarif(log)
    assert log["runs"][0]["results"] == []


def test_sarif_has_findings_of_other_tools_without_a_rule() -> None:
    log = json.loads(render_sarif(FOUND, Tool("rossmarie", "0.1.0", ())))
    check_sarif(log)
    results = log["runs"][0]["results"]
    assert [each["ruleId"] for each in results] == [each.code for each in FOUND]
    assert not any("ruleIndex" in each for each in results)


def test_sarif_columns_count_code_points_and_paths_are_uris() -> None:
    file = SourceFile("/rules/my arm.ross", '"🤖" == force')
    log = json.loads(render_sarif([warning(place(file, "force"))], TOOL))
    (result,) = log["runs"][0]["results"]
    location = result["locations"][0]["physicalLocation"]
    assert location["artifactLocation"]["uri"] == "file:///rules/my%20arm.ross"
    assert location["region"]["startColumn"] == 8


def test_sarif_keeps_the_bytes_of_undecodable_paths() -> None:
    file = SourceFile("r\udcff.ross", "force")
    log = json.loads(render_sarif([warning(place(file, "force"))], TOOL))
    location = log["runs"][0]["results"][0]["locations"][0]["physicalLocation"]
    assert location["artifactLocation"]["uri"] == "r%FF.ross"


def check_sarif(log: Any) -> None:
    """The parts of the standard (SARIF 2.1.0, sections in comments) that this tool uses."""
    assert log["version"] == "2.1.0"  # 3.13.2
    assert log["$schema"].endswith("sarif-2.1.0.json")  # 3.13.3
    for run in log["runs"]:  # 3.13.4
        assert run["columnKind"] in ("utf16CodeUnits", "unicodeCodePoints")  # 3.14.17
        driver = run["tool"]["driver"]  # 3.18.2
        assert driver["name"]
        for rule in driver["rules"]:  # 3.49
            assert re.fullmatch(r"[A-Z][A-Za-z0-9]*", rule["name"])
            assert rule["shortDescription"]["text"]
            assert rule["help"]["text"]  # 3.49.13: text is required where Markdown is there
            assert rule["defaultConfiguration"]["level"] in ("error", "warning", "note")
        for result in run["results"]:
            check_result(result, driver["rules"])


def check_result(result: Any, rules: Any) -> None:
    if "ruleIndex" in result:  # 3.27.6: it may be absent
        assert rules[result["ruleIndex"]]["id"] == result["ruleId"]
    assert result["level"] in ("error", "warning", "note")  # 3.27.10
    assert isinstance(result["message"]["text"], str)  # 3.11.8
    related = result.get("relatedLocations", [])
    assert len({place["id"] for place in related}) == len(related)  # 3.28.2
    for place_ in (*result["locations"], *related):
        check_location(place_["physicalLocation"])
    for fix in result.get("fixes", []):  # 3.55
        assert fix["artifactChanges"]
        for change in fix["artifactChanges"]:  # 3.56
            for replacement in change["replacements"]:  # 3.57
                check_region(replacement["deletedRegion"])
                assert isinstance(replacement["insertedContent"]["text"], str)


def check_location(location: Any) -> None:
    uri = location["artifactLocation"]["uri"]
    assert re.fullmatch(r"[A-Za-z0-9\-._~:/?#\[\]@!$&'()*+,;=%]*", uri)  # 3.4.3: RFC 3986
    check_region(location["region"])


def check_region(region: Any) -> None:
    start = (region["startLine"], region["startColumn"])
    end = (region["endLine"], region["endColumn"])
    assert (1, 1) <= start <= end  # 3.30: counted from 1; the end is exclusive
    assert min(*start, *end) >= 1
