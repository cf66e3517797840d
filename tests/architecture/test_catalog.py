"""Every diagnostic is in the catalog, has a code of its own, valid texts and a page."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import re
from collections import Counter
from collections.abc import Iterator
from importlib.resources import files

import pytest

import rossmarie
from dslkit.diagnostics import Error, Severity, Template, Warning
from rossmarie.catalog import DIAGNOSTICS, UnknownCodeError, page, sarif_rules

# Which hundreds a stage may use: 0 syntax, 1 names and declarations, 2 types, 3 units and time,
# 4 meaning, 5 targets, 6 recordings, 8 files and configuration, 9 defects of the tool.
HUNDREDS = {
    "syntax": {0},
    "check": {1, 2, 3, 4, 8},
    "lowering": {4},
    "targets": {5},
    "native": {5},
    "recordings": {6},
    "driver": {8},
    "catalog": {9},
}
SECTIONS = ["What it means", "Example", "Write instead"]


def declared() -> Iterator[type[Template]]:
    """Every diagnostic class of the package, found by importing all of it."""
    for module in pkgutil.walk_packages(rossmarie.__path__, "rossmarie."):
        members = vars(importlib.import_module(module.name)).values()
        for member in members:
            is_class = inspect.isclass(member) and issubclass(member, Template)
            if is_class and member not in (Template, Error, Warning):
                yield member


def test_the_catalog_names_every_diagnostic_once() -> None:
    assert [count for count in Counter(DIAGNOSTICS).values() if count > 1] == []
    missing = {found.__qualname__ for found in set(declared()) - set(DIAGNOSTICS)}
    assert missing == set()


@pytest.mark.parametrize("attribute", ["code", "name"])
def test_codes_and_names_are_unique(attribute: str) -> None:
    counts = Counter(getattr(found, attribute) for found in DIAGNOSTICS)
    assert [name for name, count in counts.items() if count > 1] == []


@pytest.mark.parametrize("found", DIAGNOSTICS, ids=lambda found: found.code)
def test_a_diagnostic_is_declared_properly(found: type[Template]) -> None:
    assert re.fullmatch(r"ROSS\d{3}", found.code)
    assert re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", found.name)
    found.check_placeholders()
    stage = found.__module__.split(".")[1]
    assert int(found.code[4]) in HUNDREDS[stage]


@pytest.mark.parametrize("found", DIAGNOSTICS, ids=lambda found: found.code)
def test_a_diagnostic_has_a_page(found: type[Template]) -> None:
    text = page(found.code)
    assert text.split("\n")[0] == f"# {found.code} {found.name}"
    reason = "an error" if found.severity is Severity.ERROR else "a warning"
    headings = re.findall(r"^## (.*)$", text, flags=re.MULTILINE)
    assert headings == [*SECTIONS, f"Why it is {reason}"]
    assert text.endswith("\n")


def test_there_is_no_page_without_a_diagnostic() -> None:
    pages = {entry.name for entry in files("rossmarie.catalog").joinpath("pages").iterdir()}
    assert pages == {f"{found.code}.md" for found in DIAGNOSTICS}


def test_a_page_is_found_by_code_and_name_in_any_case() -> None:
    expected = page("ROSS900")
    for spelling in ("ross900", " Ross900 ", "internal-error", "Internal-Error"):
        assert page(spelling) == expected


@pytest.mark.parametrize(("asked", "meant"), [("ROSS9000", "ROSS900"), ("Intern-Err", "internal")])
def test_an_unknown_code_is_answered_with_a_suggestion(asked: str, meant: str) -> None:
    with pytest.raises(UnknownCodeError, match=f"did you mean.*{meant}"):
        page(asked)


def test_nothing_is_suggested_for_something_else() -> None:
    with pytest.raises(UnknownCodeError, match=r"`zzzz`$"):
        page("zzzz")


def test_sarif_has_a_rule_with_a_summary_for_every_diagnostic() -> None:
    tool = sarif_rules("1.0")
    assert [rule.code for rule in tool.rules] == [found.code for found in DIAGNOSTICS]
    assert [rule.code for rule in tool.rules if not rule.summary] == []
