"""The page that compares EzSkiROS with SkiROS2: its column of EzSkiROS comes from checks."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

from dslkit.diagnostics import Diagnostic
from ezskiros.driver import Checked
from support.skill_files import HEADER, checked, described
from support.trees import PARAMETERS, primitive, tree

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "reference" / "compared-with-skiros2.md"
FAULTS: list[dict[str, Any]] = tomllib.loads(
    (ROOT / "tests/fixtures/ezskiros/baseline.toml").read_text(encoding="utf-8")
)["fault"]
HEAD = """\
# Compared with SkiROS2

This page compares the reactions of SkiROS2 and EzSkiROS to faults in a skill: in its description,
its behavior tree, its methods and its module. The columns of SkiROS2 were measured with its core
(master of 2024-09-24, c4438e7), without ROS. SkiROS2 loaded every skill, except where the second
column is "load". EzSkiROS reports each fault before a skill runs. A test runs EzSkiROS and writes
the last column.

| Fault | SkiROS2 detects it | Message of SkiROS2 | Message of EzSkiROS, with the source text |
|---|---|---|---|
"""


def checked_fault(fault: dict[str, Any]) -> Checked:
    """The result of a check of a skill with the fault."""
    if "tree" in fault:
        return tree(fault["tree"], fault.get("parameters", PARAMETERS))
    if "methods" in fault:
        return primitive(fault["methods"])
    if "module" in fault:
        return checked(f"{HEADER}\n\n{fault['module']}\n")
    return described(fault["body"], fault["parameters"])


def finding(fault: dict[str, Any]) -> Diagnostic:
    """The first finding, errors before warnings."""
    found = checked_fault(fault).diagnostics
    assert found, f"nothing is found: {fault['fault']}"
    return min(found, key=lambda each: (each.severity.value, each.primary.span.start))


def row(fault: dict[str, Any]) -> str:
    found = finding(fault)
    link = f"[{found.code}](../../src/ezskiros/catalog/pages/{found.code}.md)"
    place = found.primary.span.text.partition("\n")[0]
    said = f"{link} {found.title}" + (f": `{place}`" if place else "")
    if found.help and found.help.startswith("did you mean"):
        said += f" ({found.help})"
    return f"| {fault['fault']} | {fault['when']} | {fault['says']} | {said} |".replace("\\|", "|")


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault["fault"])
def test_each_fault_is_found_before_anything_runs(fault: dict[str, Any]) -> None:
    assert finding(fault).code.startswith("EZS")


def test_the_page_says_what_is_found(bless: bool) -> None:
    text = HEAD + "".join(f"{row(fault)}\n" for fault in FAULTS)
    if bless:
        PAGE.write_text(text, encoding="utf-8")
    assert PAGE.read_text(encoding="utf-8") == text
